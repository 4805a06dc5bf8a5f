#pragma once

namespace couloir {

// How often cells may be halved.
inline constexpr int most_levels = 6;

}  // namespace couloir
