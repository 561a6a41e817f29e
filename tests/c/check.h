/* A check that ends the program and says where, what, and landfall's last message. */
#ifndef LANDFALL_TESTS_CHECK_H
#define LANDFALL_TESTS_CHECK_H

#include <stdio.h>
#include <stdlib.h>

#include "landfall.h"

#define CHECK(condition)                                                                      \
  do {                                                                                        \
    if (!(condition)) {                                                                       \
      fprintf(stderr, "%s:%d: %s is false; last error: %s\n", __FILE__, __LINE__, #condition, \
              landfall_last_error());                                                         \
      exit(1);                                                                                \
    }                                                                                         \
  } while (0)

#define CHECK_OK(call) CHECK((call) == LANDFALL_OK)

#endif
