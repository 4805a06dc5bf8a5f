#pragma once
// Rectangles in which cells are wanted finer, and what that means for a leaf of the forest.

#include <vector>

#include "continuum/mesh/forest.hpp"
#include "continuum/mesh/level_cells.hpp"
#include "continuum/mesh/refinement.hpp"

namespace couloir {

// Cells halved `level` times.
struct Wish {
  double x0, x1, y0, y1;  // [m]
  int level;
};

// One for each level of each box, larger by its margin from level to level.
std::vector<Wish> wishes_of(const std::vector<RefineBox>&);

// What reaches over a periodic side is also wanted where it comes in on the other one.
void wrap(std::vector<Wish>&, const Grid&, bool periodic_x, bool periodic_y);

// The greatest level among the wishes that meet the leaf; a leaf of level 0 has edge x edge cells of the grid.
int wished_level(const std::vector<Wish>&, const Leaf&, const Grid&, int edge);

// Takes the forest as far towards the wishes as one level more or less, anywhere, goes; returns whether anything has changed. And
// all the way.
bool grow(Forest&, const std::vector<Wish>&, const Grid&, int edge);
void grow_fully(Forest&, const std::vector<Wish>&, const Grid&, int edge);

// The cells of a mesh of whole blocks once the boxes are refined, by level.
std::vector<LevelCells> count_levels(const Grid&, int edge, bool periodic_x, bool periodic_y, const std::vector<RefineBox>&);

}  // namespace couloir
