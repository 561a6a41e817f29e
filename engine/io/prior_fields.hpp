// Kinds of priors that more than one format holds.
#pragma once

#include "engine/io/document.hpp"
#include "landfall/prior.hpp"

namespace landfall::io {

Window read_window(const Field& field);
Region read_region(const Field& field);

}  // namespace landfall::io
