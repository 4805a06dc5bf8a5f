#pragma once
// The columns of /windows: name, unit, meaning and where in a WindowReport the number is. Declared once; the writer makes its
// datasets from this table and readers find them by name.
#include <vector>

#include "coupling/loop/observer.hpp"

namespace couloir {

struct WindowColumn {
  const char* name;
  const char* unit;
  const char* description;
  double (*value)(const WindowReport&);
};

const std::vector<WindowColumn>& window_columns();

}  // namespace couloir
