// Grains put in and taken out.
#include <gmock/gmock.h>

#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;
using testing::HasSubstr;

struct Exchange : OnEngine {};

INSTANTIATE_TEST_SUITE_P(On, Exchange, engines, name_of_engine);

TEST_P(Exchange, StartsEmptyAndFallsFreely) {
  Folder folder;
  WorkerEngine engine(worker());
  const EngineSetup setup = box(folder.path);
  engine.start(setup);
  EXPECT_THAT(engine.name(), HasSubstr(yade() ? "YADE 2023" : "LIGGGHTS 3.8.0"));
  EXPECT_EQ(engine.advance(steps(10)).grains.size(), 0u);
  AdvanceRequest request = steps(100);
  NewGrain grain;
  grain.id = 5;
  grain.position = {0.02, 0.02, 0.06};
  grain.velocity = {0.1, 0, 0};
  grain.radius = 0.002;
  request.insert = {grain};
  const Advanced a = engine.advance(request);
  const double t = 100 * setup.timestep;
  ASSERT_EQ(a.grains.id, std::vector<std::int64_t>{5});
  EXPECT_NEAR(a.grains.x[0], 0.02 + 0.1 * t, 1e-15);
  EXPECT_NEAR(a.grains.z[0], 0.06 - 0.5 * g * t * t, 1e-15);
  EXPECT_NEAR(a.grains.vz[0], -g * t, 1e-13);
  EXPECT_EQ(a.step, 110);
}

namespace {

// A settled box; then, four times, `count` grains far above it come and go again. Returns the grains that stay.
Grains with_visitors(const std::string& worker, int ranks, int count, int settling = 3000) {
  Folder folder;
  EngineSetup setup = box(folder.path);
  setup.ranks = ranks;
  WorkerEngine engine(worker);
  engine.start(setup);
  AdvanceRequest request = steps(settling);
  request.insert = lattice(8, 4);
  engine.advance(request);
  std::vector<std::int64_t> ids;
  for (int k = 0; k < 4; ++k) {
    request = steps(50);
    request.remove = ids;
    ids.clear();
    for (int n = 0; n < count; ++n) {
      NewGrain visitor;
      visitor.id = 1000 + 10 * k + n;
      visitor.position = {0.008 + 0.008 * n, 0.01 + 0.004 * n, 0.07};
      visitor.radius = 0.002;
      request.insert.push_back(visitor);
      ids.push_back(visitor.id);
    }
    engine.advance(request);
  }
  request = steps(500);
  request.remove = ids;
  return engine.advance(request).grains;
}

}  // namespace

TEST_P(Exchange, LeavesTheOtherGrainsTheirBits) {
  for (const int ranks : OnEngine::ranks()) {
    const Grains one = with_visitors(worker(), ranks, 1), three = with_visitors(worker(), ranks, 3);
    EXPECT_EQ(one.size(), 256u);
    EXPECT_TRUE(same_bits(one, three)) << ranks << " ranks";
  }
}

// An exchange builds the neighbour lists anew, and forces are then summed in another order: round-off, but no lost contact.
TEST_P(Exchange, KeepsTheContactsOfTheOthers) {
  const Grains none = with_visitors(worker(), 1, 0, 30000), three = with_visitors(worker(), 1, 3, 30000);
  ASSERT_EQ(none.size(), three.size());
  double largest = 0;
  for (std::size_t i = 0; i < none.size(); ++i) {
    largest =
        std::max({largest, std::abs(none.x[i] - three.x[i]), std::abs(none.y[i] - three.y[i]), std::abs(none.z[i] - three.z[i])});
  }
  EXPECT_LT(largest, 1e-9 * d);
}

TEST_P(Exchange, RefusesWhatCannotBe) {
  const auto error = [](auto&& change) {
    Folder folder;
    WorkerEngine engine(worker());
    engine.start(box(folder.path));
    AdvanceRequest request = steps(5);
    request.insert = lattice(2, 2);
    engine.advance(request);
    request.insert.clear();
    change(request);
    const std::string text = error_of([&] { engine.advance(request); });
    EXPECT_EQ(engine.worker_pid(), 0);
    EXPECT_THAT(error_of([&] { engine.advance(steps(1)); }), HasSubstr("not running"));
    return text;
  };
  EXPECT_THAT(error([](AdvanceRequest& r) { r.remove = {3, 77}; }), HasSubstr("the grain 77 is to be removed, which is unknown"));
  EXPECT_THAT(error([](AdvanceRequest& r) { r.remove = {3, 3}; }), HasSubstr("the grain 3 is to be removed twice"));
  EXPECT_THAT(error([](AdvanceRequest& r) { r.insert = lattice(1, 1, 8); }),
              HasSubstr("the new grain 8 has the id of a grain that is there already"));
  EXPECT_THAT(error([](AdvanceRequest& r) { r.insert = lattice(1, 1, 3'000'000'000); }),
              HasSubstr("id must be in 1..2147483647"));
  EXPECT_THAT(error([](AdvanceRequest& r) {
                r.insert = lattice(1, 1, 50);
                r.insert[0].position[2] = 1;
              }),
              HasSubstr("lies outside of the box"));
  EXPECT_THAT(error([](AdvanceRequest& r) {
                r.insert = lattice(1, 1, 50);
                r.insert[0].velocity[1] = std::nan("");
              }),
              HasSubstr("no finite position, velocity or spin"));
}

TEST_P(Exchange, NamesGrainsThatLeftTheBox) {
  Folder folder;
  EngineSetup setup = box(folder.path);
  setup.surfaces.resize(1);  // no walls
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(4000);
  request.insert = lattice(8, 2);
  request.insert[0].velocity = request.insert[1].velocity = {0, -3, 0};
  EXPECT_THAT(error_of([&] { engine.advance(request); }), HasSubstr("grains have left the box"));
}
