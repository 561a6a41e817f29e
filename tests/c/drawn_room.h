/* A room of 7.2 x 4.8 m that looks different from every place and heading; a character is 4 x 4 cells of 5
 * cm. */
#ifndef LANDFALL_TESTS_DRAWN_ROOM_H
#define LANDFALL_TESTS_DRAWN_ROOM_H

#include "check.h"

enum { DRAWN_ROWS = 24, CELLS_PER_CHARACTER = 4, ROOM_WIDTH = 36 * 4, ROOM_HEIGHT = 24 * 4 };

/* clang-format off */
static const char* const ROOM[DRAWN_ROWS] = {
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

static char drawn(int row, int col) {
  return ROOM[DRAWN_ROWS - 1 - row / CELLS_PER_CHARACTER][col / CELLS_PER_CHARACTER];
}

static landfall_map* make_room(void) {
  static uint8_t cells[ROOM_WIDTH * ROOM_HEIGHT];
  for (int row = 0; row < ROOM_HEIGHT; ++row)
    for (int col = 0; col < ROOM_WIDTH; ++col)
      cells[row * ROOM_WIDTH + col] = drawn(row, col) == '#' ? LANDFALL_OCCUPIED : LANDFALL_FREE;
  const landfall_grid grid = {ROOM_WIDTH, ROOM_HEIGHT, 0.05, {0.0, 0.0, 0.0}, cells};
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
