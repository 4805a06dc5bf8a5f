#pragma once
// What may keep grains from turning: spheres stand for angular grains (the dissertation's section 4.3).

#include <cmath>
#include <string>

namespace couloir {

// free: contacts alone turn a grain; blocked: none turns; control: below.
enum class Rotation { free, blocked, control };

// The rule of that name, as grains.rotation has it. Throws std::invalid_argument.
Rotation rotation(const std::string& name);
const char* to_string(Rotation);

// Rotation control, (4.11)-(4.13). A grain with c >= 1 contacts, other grains and surfaces alike, whose shear velocity is v_s
//
//   slides or rolls   at rest in spin: it stays so while v_s < v_sr; spinning: it stops where v_s < v_rs
//   slows its spin    w <- k^(dt / lambda) w,   k = 1 / (1 + c^chi),   lambda = k_v v_s + lambda_c
//
// v_s [m/s]: how fast the grain's centre moves along its contacts' planes relative to the other's centre, mean over the contacts;
// a surface is at rest. Without a contact the spin is left alone, whatever chi. A raft's grains never spin (grain_engine.hpp).
struct RotationControl {
  double retarding_time = 0;     // [s] lambda_c, above 0
  double contact_influence = 1;  // [-] chi
  double shear_influence = 0;    // [s2/m] k_v
  double slide_to_roll = 0;      // [m/s] v_sr
  double roll_to_slide = 0;      // [m/s] v_rs, at most v_sr

  bool needs_shear() const { return shear_influence > 0 || slide_to_roll > 0; }
  bool slides(bool spins, double shear) const { return shear < (spins ? roll_to_slide : slide_to_roll); }
  // By which the spin changes within `time` [s] of `contacts` >= 1.
  double factor(int contacts, double shear, double time) const {
    const double k = 1 / (1 + std::pow(contacts, contact_influence));
    return std::pow(k, time / (shear_influence * shear + retarding_time));
  }
};

}  // namespace couloir
