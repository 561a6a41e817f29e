#pragma once

#include "landfall/search.hpp"

namespace landfall::internal {

// Throws Error{invalid_argument} that names the option, the value and what is accepted. Steps are
// checked against the map where the lattice is made, the method's name where it is looked up.
void validate(const SearchOptions& options);

// Throws Error{unknown_name} where LANDFALL_ISA or LANDFALL_EXECUTOR names what is not there.
void validate_environment();

}  // namespace landfall::internal
