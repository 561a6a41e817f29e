#include <stdio.h>

#include "landfall.h"

int main(void) {
  landfall_map* map = NULL;
  const landfall_status status = landfall_map_load("no/such/map.yaml", &map);
  printf("landfall %s: %s\n", landfall_version(), landfall_last_error());
  return status == LANDFALL_FILE_NOT_FOUND && map == NULL ? 0 : 1;
}
