#include "coupling/scene/schema.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace couloir {
namespace {

TEST(Schema, HasEveryKeyOnceWithHelp) {
  std::set<std::string> paths;
  for (const Key& key : schema()) {
    EXPECT_TRUE(paths.insert(key.path).second) << key.path << " is declared twice";
    EXPECT_FALSE(key.help.empty()) << key.path;
    EXPECT_LE(key.bounds.least, key.bounds.most) << key.path;
    if (!key.selector.empty()) {
      EXPECT_NO_THROW(schema_key(key.parent() + "." + key.selector)) << key.path;
    }
    const std::string parent = key.parent();
    if (!parent.empty() && !parent.ends_with("*")) {
      EXPECT_TRUE(paths.contains(parent)) << key.path << " comes before its mapping";
    }
  }
  EXPECT_THROW(schema_key("grains.sed"), std::out_of_range);
}

TEST(Schema, SetsWhatItGets) {
  for (const Key& key : schema()) {
    if (!key.get || !key.set) continue;
    Scene scene;
    scene.obstacles.emplace_back();
    scene.stress_gauges.emplace_back();
    scene.record.gauges.emplace_back();
    scene.continuum.refine.emplace_back();
    for (SideSpec& side : scene.sides) side.hydrograph.emplace_back();
    scene.grains.zones.assign(2, {});
    scene.terrain.profile.emplace_back();
    Value value = key.get(scene, 0);
    if (auto* x = std::get_if<double>(&value)) *x = 0.375;
    if (auto* n = std::get_if<long>(&value)) *n = 37;
    if (auto* list = std::get_if<std::vector<double>>(&value)) {
      for (std::size_t i = 0; i < list->size(); ++i) (*list)[i] = 1.5 + static_cast<double>(i);
    }
    if (auto* word = std::get_if<std::string>(&value)) *word = key.choices.empty() ? "some text" : key.choices.back();
    key.set(scene, 0, value);
    EXPECT_EQ(key.get(scene, 0), value) << key.path;
  }
}

TEST(Schema, DefaultsAreWithinBounds) {
  for (const Key& key : schema()) {
    if (!key.get || key.presence != Presence::defaulted) continue;
    Scene scene;
    scene.obstacles.emplace_back();
    scene.stress_gauges.emplace_back();
    scene.record.gauges.emplace_back();
    scene.continuum.refine.emplace_back();
    if (key.path.starts_with("grains.zone")) continue;
    const Value value = key.get(scene, 0);
    if (value == Value(0.0) && !key.choices.empty()) continue;  // a word
    if (const auto* x = std::get_if<double>(&value)) {
      EXPECT_TRUE(*x <= key.bounds.most && (key.bounds.above ? *x > key.bounds.least : *x >= key.bounds.least))
          << key.path << " " << *x;
    }
  }
}

TEST(Schema, ReferenceNamesEveryKey) {
  const std::string page = scene_reference();
  for (const Key& key : schema()) EXPECT_NE(page.find("| `" + key.path + "` |"), std::string::npos) << key.path;
  EXPECT_NE(page.find("| `continuum.cfl` | number | 0.45 | above 0 and at most 0.5 |"), std::string::npos) << page;
  EXPECT_NE(page.find("| `terrain.angle` | an angle [rad] | required there | from 0 deg to 89 deg |"), std::string::npos) << page;
}

}  // namespace
}  // namespace couloir
