/* A room of 3.6 x 2.4 m that looks different from every place and heading. */
#ifndef LANDFALL_TESTS_DRAWN_ROOM_H
#define LANDFALL_TESTS_DRAWN_ROOM_H

#include "check.h"

enum { ROOM_WIDTH = 36, ROOM_HEIGHT = 24 };

/* clang-format off */
static const char* const ROOM[ROOM_HEIGHT] = {
    "####################################",
    "#..................#...............#",
    "#..................#...............#",
    "#..................#...............#",
    "#..................................#",
    "#..................................#",
    "#..................................#",
    "#..................#...............#",
    "#..................#...............#",
    "######.....#########......###......#",
    "#.........................###......#",
    "#.........................###......#",
    "#..................................#",
    "#..................................#",
    "#..................................#",
    "#......##..........................#",
    "#......##..........................#",
    "#...................#..............#",
    "#..................##..............#",
    "#.................###..............#",
    "#................####..............#",
    "#...............#####..............#",
    "#...............#####..............#",
    "####################################",
};
/* clang-format on */

static landfall_map* make_room(void) {
  static uint8_t cells[ROOM_WIDTH * ROOM_HEIGHT];
  for (int row = 0; row < ROOM_HEIGHT; ++row)
    for (int col = 0; col < ROOM_WIDTH; ++col)
      cells[row * ROOM_WIDTH + col] =
          ROOM[ROOM_HEIGHT - 1 - row][col] == '#' ? LANDFALL_OCCUPIED : LANDFALL_FREE;
  const landfall_grid grid = {ROOM_WIDTH, ROOM_HEIGHT, 0.1, {0.0, 0.0, 0.0}, cells};
  landfall_map* map = NULL;
  CHECK_OK(landfall_map_from_grid(&grid, &map));
  return map;
}

/* A scanner that sees all around. */
static landfall_sensor* make_scanner(void) {
  landfall_fan_options fan;
  landfall_fan_options_init(&fan);
  fan.beam_count = 360;
  fan.first_rad = -3.14159265358979;
  fan.range_max_m = 10.0;
  landfall_sensor* sensor = NULL;
  CHECK_OK(landfall_sensor_fan(&fan, &sensor));
  return sensor;
}

#endif
