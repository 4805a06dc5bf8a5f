#pragma once
// std::max and std::min by value: their references to named variables keep a loop from vectorising. Same results, also for NaN.

namespace couloir {

inline double larger(double a, double b) {
  return a < b ? b : a;
}
inline double smaller(double a, double b) {
  return b < a ? b : a;
}

}  // namespace couloir
