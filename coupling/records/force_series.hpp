#pragma once
// The force on one obstacle against time, and its key figures.
#include <vector>

#include "coupling/checkpoint/archive.hpp"

namespace couloir {

// What a force history is reduced to. All of them are of one component: f(t), constant in each window.
struct ForceFigures {
  double peak = 0;            // [N] the 15 ms running mean of f where it is largest in magnitude, with its sign; a contact
                              // shorter than that is averaged over its own length
  double peak_time = 0;       // [s] end of those 15 ms
  double peak_window = 0;     // [N] the single window's mean that is largest in magnitude: noisier, falls with longer windows
  double mean = 0;            // [N] from the first contact to the end
  double mean_of_run = 0;     // [N] from the start to the end
  double final = 0;           // [N] mean of the last 50 ms (of the whole run where that is shorter)
  double impulse = 0;         // [N s] integral of f over the run
  double first_contact = -1;  // [s] start of the first window with a thousandth of the largest window's force;
                              // -1: never
};

class ForceSeries {
 public:
  static constexpr double kPeakSpan = 0.015;   // [s]
  static constexpr double kFinalSpan = 0.050;  // [s]
  static constexpr double kContactShare = 1e-3;

  // `time` at the window's end and `length` [s], `force` its mean [N]; `contact`: any component of the force is not zero.
  void add(double time, double length, double force, bool contact);
  // The running mean at t is (J(t) - J(t - 15 ms)) / 15 ms with J the impulse so far, linear within a window; J = 0 before the
  // start. It is largest at a window's end, or 15 ms after one, so these times are all that is looked at.
  ForceFigures figures() const;
  void state(Archive& a) { a(end_, begin_, force_, impulse_, contact_); }

 private:
  double contact(double largest) const;                // [s]
  double impulse_at(double time) const;                // [N s]
  std::vector<double> end_, begin_, force_, impulse_;  // impulse_: at end_
  double contact_ = -1;
};

}  // namespace couloir
