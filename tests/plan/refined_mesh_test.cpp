// A refined scene: what the solver is told, how many cells that makes, what the plan says.

#include "coupling/plan/refined_mesh.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "continuum/noc/nested_noc.hpp"
#include "coupling/plan/build.hpp"
#include "coupling/plan/effects.hpp"
#include "coupling/plan/plan.hpp"
#include "plan_scenes.hpp"

namespace couloir {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const Overrides about_the_wall{
    {"mode", "continuum"},
    {"continuum.refine", "[{around: wall, up: 100 mm, down: 20 mm, left: 30 mm, right: 30 mm, levels: 2}]"}};

Overrides with(Overrides first, const Overrides& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

Effect refinement(const Scene& scene) {
  for (const Effect& e : effects_of(scene)) {
    if (e.name == "refinement") return e;
  }
  return {};
}

TEST(RefinedMesh, SettingsOfTheSolver) {
  SolverSettings s = solver_settings(experiment("chiou_wall", about_the_wall));
  ASSERT_EQ(s.refinement.boxes.size(), 1u);
  const RefineBox& b = s.refinement.boxes[0];
  EXPECT_DOUBLE_EQ(b.x0, 0.55);
  EXPECT_DOUBLE_EQ(b.x1, 0.68);
  EXPECT_DOUBLE_EQ(b.y1, 0.11);
  EXPECT_EQ(b.levels, 2);
  EXPECT_EQ(s.block, 16);
  EXPECT_EQ(solver_settings(experiment("chiou_wall")).block, 32);
  EXPECT_TRUE(solver_settings(experiment("chiou_wall")).refinement.empty());

  s = solver_settings(experiment("chiou_wall", {{"continuum.refine", "[{around: wall, up: 2 m, down: 9 m, right: 9 m}]"}}));
  EXPECT_EQ(s.refinement.boxes[0].x0, 0) << "cut off at the domain";
  EXPECT_EQ(s.refinement.boxes[0].x1, 1.915);
  EXPECT_EQ(s.refinement.boxes[0].y1, 0.4);

  s = solver_settings(experiment(
      "chiou_wall",
      {{"continuum.adapt", "{levels: 3, interval: 5, front: off, gradient: 0.2, zone: off}"}, {"continuum.block", "24"}}));
  EXPECT_EQ(s.block, 24);
  EXPECT_EQ(s.refinement.adaptive.levels, 3);
  EXPECT_EQ(s.refinement.adaptive.interval, 5);
  EXPECT_FALSE(s.refinement.adaptive.front);
  EXPECT_EQ(s.refinement.adaptive.gradient, 0.2);
  EXPECT_FALSE(s.refinement.adaptive.zone);
}

TEST(RefinedMesh, BedIsAFunctionOfPlaceToo) {
  const Scene s = experiment("wedge_force");
  const StepBed bed = step_bed(s);
  const Grid g = grid_of(s);
  ASSERT_TRUE(bed.height && bed.owner_at);
  double highest = 0;
  for (int j = 0; j < g.ny; ++j) {
    for (int i = 0; i < g.nx; ++i) {
      const std::size_t c = std::size_t(j) * g.nx + i;
      EXPECT_EQ(bed.height(g.x(i), g.y(j)), bed.elevation[c]);
      EXPECT_EQ(bed.owner_at(g.x(i), g.y(j)), bed.owner[c]);
      highest = std::max(highest, bed.elevation[c]);
    }
  }
  EXPECT_GT(highest, 0.7);
  EXPECT_FALSE(step_bed(experiment("chiou_wall")).height);
}

TEST(RefinedMesh, CountsTheSolversOwnBlocks) {
  for (const Overrides& more : {Overrides{},
                                {{"continuum.block", "8"}},
                                {{"continuum.refine[0].margin", "40 mm"}},
                                {{"boundaries", "{left: periodic, right: periodic}"}, {"continuum.refine[0].right", "400 mm"}}}) {
    const Scene s = experiment("chiou_wall", with(about_the_wall, more));
    const Solver solver(solver_settings(s), reference_surface(s), step_bed(s));
    std::vector<LevelCells> seen(3);
    for (const BlockPlace& b : solver.blocks()) ++seen[b.level].blocks, seen[b.level].cells += b.nx * b.ny;
    const std::vector<LevelCells> planned = planned_levels(s);
    ASSERT_EQ(planned.size(), 3u);
    double area = 0;
    for (int l = 0; l < 3; ++l) {
      EXPECT_EQ(planned[l].blocks, seen[l].blocks) << l;
      EXPECT_EQ(planned[l].cells, seen[l].cells) << l;
      EXPECT_DOUBLE_EQ(planned[l].cell, solver.grid().dx / (1 << l));
      area += std::ldexp(double(planned[l].cells), -2 * l);
    }
    EXPECT_EQ(area, 383 * 160);
  }
}

TEST(RefinedMesh, CountsThePatchesOfNoc) {
  const Scene s =
      experiment("chiou_wall", with(about_the_wall, {{"continuum.scheme", "noc"}, {"obstacles.wall.method", "elevation"}}));
  const NestedNoc solver(solver_settings(s), reference_surface(s), noc_bed(s));
  const std::vector<LevelCells> planned = planned_levels(s);
  ASSERT_EQ(planned.size(), 3u);
  EXPECT_EQ(planned[0].cells, 383 * 160);
  std::int64_t patches = 0;
  for (const LevelCells& l : planned) patches += l.level > 0 ? l.blocks : 0;
  EXPECT_EQ(patches, solver.patches());
  for (int k = 0; k < solver.patches(); ++k) {
    const Grid g = solver.patch_grid(k);
    EXPECT_EQ(planned[solver.level(k)].cells, std::int64_t{g.nx} * g.ny);
  }
}

TEST(RefinedMesh, PlanSaysCellsByLevelAndWhatTheyCost) {
  const Plan uniform = make_plan(experiment("chiou_wall", {{"mode", "continuum"}}));
  const Plan plan = make_plan(experiment("chiou_wall", about_the_wall));
  EXPECT_TRUE(uniform.levels.empty());
  EXPECT_EQ(plan.cells, plan.levels[0].cells + plan.levels[1].cells + plan.levels[2].cells);
  EXPECT_GT(plan.cells, uniform.cells);
  EXPECT_GT(plan.memory, uniform.memory);
  // Cells of level 2 step four times in a step of level 0.
  const double more = 2.0 * double(plan.levels[1].cells) + 4.0 * double(plan.levels[2].cells);
  EXPECT_NEAR(plan.time_continuum - uniform.time_continuum, 2.0 * double(plan.steps) * more / 3e7, 1e-6);
  const std::string text = plan_text(plan);
  EXPECT_THAT(text, HasSubstr("level 2: " + std::to_string(plan.levels[2].cells) + " cells of 1.25 mm, "));
  EXPECT_EQ(plan_json(plan)["continuum"]["levels"][1]["cell"], 0.0025);
  EXPECT_EQ(plan_json(uniform)["continuum"]["levels"].size(), 0u);

  const Plan adaptive = make_plan(experiment("chiou_wall", {{"mode", "continuum"}, {"continuum.adapt.levels", "2"}}));
  EXPECT_THAT(plan_text(adaptive), HasSubstr("more where the flow asks, down to 1.25 mm: about " +
                                             std::to_string(adaptive.followed_cells) + " cells in all\n"));
  EXPECT_GT(adaptive.time_continuum, uniform.time_continuum);

  // What looks ahead further is refined wider, to no more than all cells.
  const auto looking = [](const char* interval) {
    return make_plan(experiment(
        "chiou_wall", {{"mode", "continuum"}, {"continuum.adapt.levels", "2"}, {"continuum.adapt.interval", interval}}));
  };
  const Plan usual = looking("8"), seldom = looking("40"), never = looking("10000");
  EXPECT_EQ(usual.memory, adaptive.memory);
  EXPECT_GT(seldom.memory, 1.2 * usual.memory);
  EXPECT_GT(seldom.time_continuum, 1.2 * usual.time_continuum);
  EXPECT_EQ(never.followed_cells, 16 * never.cells);
}

TEST(RefinedMesh, PlanLeavesOutASizeThatNoCellHas) {
  const Plan plan = make_plan(experiment(
      "chiou_wall", {{"mode", "continuum"}, {"continuum.refine", "[{x: [0, 1.915 m], y: [-0.4 m, 0.4 m], levels: 1}]"}}));
  EXPECT_EQ(plan.levels[0].cells, 0);
  EXPECT_THAT(plan_text(plan), AllOf(HasSubstr("level 1: "), Not(HasSubstr("level 0"))));
}

TEST(RefinedMesh, PlanWarnsWhereNothingCanAskForFinerCells) {
  const auto warned = [](const Overrides& more) {
    const Plan plan = make_plan(experiment("chiou_wall", with({{"mode", "continuum"}}, more)));
    return plan_text(plan).find("continuum.adapt asks for finer cells by no sign") != std::string::npos;
  };
  EXPECT_TRUE(warned({{"continuum.adapt", "{levels: 2, front: off, gradient: 0}"}})) << "the zone's rim has no say here";
  EXPECT_FALSE(warned({{"continuum.adapt", "{levels: 2, front: off, gradient: 0}"}, {"mode", "coupled"}}));
  EXPECT_TRUE(warned({{"continuum.adapt", "{levels: 2, front: off, gradient: 0, zone: off}"}, {"mode", "coupled"}}));
  EXPECT_FALSE(warned({{"continuum.adapt", "{levels: 2, front: off, gradient: 0, obstacle: 50 mm}"}}));
  EXPECT_FALSE(warned({{"continuum.adapt", "{levels: 2}"}}));
  EXPECT_FALSE(warned({}));
}

TEST(RefinedMesh, EffectSaysWhy) {
  const auto reason = [](const Overrides& o) { return refinement(experiment("chiou_wall", o)).reason; };
  EXPECT_EQ(reason(about_the_wall),
            "blocks that share their fluxes: about wall, x 550 mm to 680 mm, y -110 mm to 110 mm: 2 levels, cells of 1.25 mm");
  EXPECT_TRUE(refinement(experiment("chiou_wall", about_the_wall)).on);
  EXPECT_EQ(reason({}), "all cells are of one size: neither continuum.refine nor continuum.adapt");
  EXPECT_FALSE(refinement(experiment("chiou_wall")).on);
  EXPECT_EQ(
      reason({{"continuum.adapt.levels", "1"}}),
      "blocks that share their fluxes: where the flow asks (fronts, changes of the surface above 0.1 of the greatest depth, the "
      "zone's rim): up to 1 level, cells of 2.5 mm");
  EXPECT_EQ(reason(with(about_the_wall, {{"mode", "grains"}})), "mode is grains: there are no cells to refine");
  EXPECT_FALSE(refinement(experiment("chiou_wall", with(about_the_wall, {{"mode", "grains"}}))).on);
}

}  // namespace
}  // namespace couloir
