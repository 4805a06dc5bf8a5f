#pragma once
// Where a measured quantity that rises with a parameter reaches its target: a bracket, made smaller.

#include <functional>
#include <vector>

namespace couloir {

struct Bracket {
  double least = 0, most = 0;  // the parameter stays within them
  double low = 0, high = 0;    // where the search begins
  double tolerance = 0;        // of the quantity: near enough to the target
  double narrow = 0;           // of the parameter: a bracket as small is the end
  int most_tries = 8;          // within the bracket
};

struct BracketTry {
  double parameter = 0, quantity = 0;
};

struct BracketResult {
  BracketTry best;           // of all tries the nearest to the target
  bool bracketed = false;    // the target lies between two tries; false: it is out of reach between least and most
  double low = 0, high = 0;  // the last bracket, where there is one
  std::vector<BracketTry> tries;
};

// Widens [low, high] towards least and most until the target lies between, in steps that double; then cuts it by the false
// position (Illinois: an end that stays counts half). A quantity that falls again before it reached the target is found out of
// reach.
BracketResult search_bracket(const Bracket&, double target, const std::function<double(double)>& quantity);

}  // namespace couloir
