// Which instruction set the kernels run with: the best that the machine has, or a lower one by name.
#pragma once

namespace landfall::kernels {

// Name of the instruction set that kernels run with: one of Highway's ("AVX3", "AVX2", "SSE4", ...) or
// "SCALAR", the plain twins that specify the kernels.
const char* isa_name();

// Use this instruction set and those below it from now on; nullptr or "" gives the best again.
// False, and nothing changed, where the name is unknown, the machine lacks it, or kernels were not compiled
// for it. Not for use while kernels run.
bool select_isa(const char* name);

bool scalar_selected();

}  // namespace landfall::kernels
