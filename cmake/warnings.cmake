# Our own targets only; dependencies' headers are system headers. gcc 12's -Wmaybe-uninitialized misfires on std::optional.
add_library(landfall_warnings INTERFACE)
target_compile_options(landfall_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow
  $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-maybe-uninitialized>
  $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast>
  $<$<BOOL:${LANDFALL_WERROR}>:-Werror>)
