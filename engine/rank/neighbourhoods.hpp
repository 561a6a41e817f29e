// Candidates that lie together: a method's best poses are often all of one place.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/query.hpp"

namespace landfall::internal {

// Indices of candidates, best score first.
using Neighbourhood = std::vector<std::size_t>;

// The candidates, best score first, by blocks of cells and ranges of headings as wide as the distinct
// rotation: those of the best scores, `most` of them, each with its best `most_members`.
std::vector<Neighbourhood> neighbourhoods(const Query& query, const std::vector<Candidate>& candidates,
                                          std::size_t most, std::size_t most_members);

}  // namespace landfall::internal
