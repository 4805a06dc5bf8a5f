#pragma once
// What of the scheme is compiled once for each instruction set (cmake/kernels.cmake). Nothing else can call these functions but
// through the table: they are visible nowhere else.

#include "continuum/scheme/face_flux.hpp"
#include "continuum/scheme/mobilisation.hpp"
#include "continuum/scheme/reconstruct.hpp"
#include "continuum/scheme/rest.hpp"
#include "continuum/scheme/stage.hpp"
#include "continuum/scheme/update.hpp"
#include "continuum/scheme/velocity.hpp"

namespace couloir {

struct Kernels {
  decltype(&couloir::begin_step) begin_step;
  decltype(&couloir::run_stage) run_stage;
  // Parts of them, for the planes of an obstacle.
  decltype(&couloir::find_velocity) find_velocity;
  decltype(&couloir::mobilise) mobilise;
  decltype(&couloir::find_earth_pressure) find_earth_pressure;
  decltype(&couloir::find_locked) find_locked;
  decltype(&couloir::find_shocks) find_shocks;
  decltype(&couloir::reconstruct_all) reconstruct_all;
  decltype(&couloir::face_fluxes) face_fluxes;
  decltype(&couloir::update) update;
};

// Those of chosen_isa(). Throws IsaError.
const Kernels& kernels();

}  // namespace couloir
