#include "landfall.h"
#include "landfall.h"  // NOLINT(readability-duplicate-include): its guard is what is tested
