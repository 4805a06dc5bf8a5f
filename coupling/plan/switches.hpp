#pragma once
// Effects that a scene leaves out by hand: `effects: {curvature: off}`. Where the plan has an effect off already, that is all;
// where the scene calls for it, the run leaves it out and says so, or refuses where it is no term but what the scene is made of.

#include <string>
#include <vector>

#include "coupling/scene/scene.hpp"

namespace couloir {

// The scene as it runs: without what it calls for and leaves out; left_out names that alone. Friction and flights have no key of
// their own: closure_of() and FlowSide ask Scene::leaves_out().
Scene as_run(const Scene&);

// A whole sentence for each effect that is switched off by hand although the scene calls for it. Throws SceneError where it
// cannot be left out.
std::vector<std::string> switched_off(const Scene&);

}  // namespace couloir
