// The contact laws, measured on single contacts: both engines must show the same.
#include <map>

#include "small_box.hpp"

using namespace couloir;
using namespace couloir::test;

namespace {

class Contact : public testing::TestWithParam<std::tuple<std::string, ContactLaw>> {
 public:
  static std::string worker() { return worker_path(std::get<0>(GetParam())); }
  static ContactLaw law() { return std::get<1>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(On, Contact, testing::Combine(engines, testing::Values(ContactLaw::hertz, ContactLaw::kelvin_voigt)),
                         [](const auto& info) { return std::get<0>(info.param) + "_" + to_string(std::get<1>(info.param)); });

EngineSetup weightless(const std::string& folder, ContactLaw law, double restitution) {
  EngineSetup s = box(folder);
  s.contact = law;
  s.restitution = restitution;
  s.linear = linear_contact(stiffness, restitution);
  s.timestep = stable_timestep(law, stiffness);
  s.gravity = {0, 0, 0};
  return s;
}

NewGrain grain(std::int64_t id, Vec position, Vec velocity) {
  NewGrain n;
  n.id = id;
  n.position = position;
  n.velocity = velocity;
  n.radius = 0.5 * d;
  return n;
}

}  // namespace

TEST_P(Contact, GivesTheRestitutionAskedForAndNeverPulls) {
  for (const auto& [asked, damped] : {std::pair{0.3, true}, {0.5, true}, {0.9, true}, {0.3, false}, {0.9, false}}) {
    Folder folder;
    EngineSetup setup = weightless(folder.path, law(), asked);
    setup.tangential_damping = damped;
    WorkerEngine engine(worker());
    engine.start(setup);
    AdvanceRequest request = steps(1);
    const double speed = 0.2, gap = 0.02 * d;
    request.insert = {grain(1, {3 * d, 5 * d, 0.5 * d + gap}, {0, 0, -speed}),
                      grain(2, {4 * d, 4 * d, 10 * d}, {0, 0, speed / 2}),
                      grain(3, {4 * d, 4 * d, 11 * d + gap}, {0, 0, -speed / 2})};
    Advanced a = engine.advance(request);
    double pull = 0, push = 0;
    for (int k = 0; k < 300; ++k) {
      a = engine.advance(steps(2));
      pull = std::max(pull, a.surface_force_last[0][2]);
      push = std::min(push, a.surface_force_last[0][2]);
    }
    EXPECT_NEAR(a.grains.vz[0] / speed, asked, 0.03) << "on a surface";
    EXPECT_NEAR((a.grains.vz[2] - a.grains.vz[1]) / speed, asked, 0.03) << "of two grains";
    EXPECT_LT(push, 0);
    if (worker() == worker_path("liggghts") && law() == ContactLaw::hertz && damped)
      continue;  // its damping does pull at the end
    EXPECT_LE(pull, 0) << "a contact pulled with " << pull << " N";
  }
}

TEST_P(Contact, SlidesWithItsCoulombFriction) {
  Folder folder;
  EngineSetup setup = weightless(folder.path, law(), 0.5);
  setup.gravity = {0, 0, -g};
  setup.surfaces[0].friction = 0.3;
  WorkerEngine engine(worker());
  engine.start(setup);
  AdvanceRequest request = steps(4000);
  request.insert = {grain(1, {2 * d, 4 * d, 0.5 * d}, {0, 0, 0})};
  engine.advance(request);  // at rest
  request.insert = {grain(2, {2 * d, 2 * d, 0.5 * d - 1e-6 * d}, {0.4, 0, 0})};
  request.steps = 400;
  engine.advance(request);
  const Advanced a = engine.advance(steps(400));
  const double weight = mass(0.5 * d) * g;
  EXPECT_NEAR(a.surface_force[0][0], 0.3 * weight, 0.01 * weight) << "one slides, the other rests";
  EXPECT_NEAR(a.surface_force[0][2], -2 * weight, 0.01 * weight);
}

// A sphere that is pushed along a plane by its weight rolls: with epsd2 only beyond the angle whose tangent is the rolling
// friction; the linear law has none.
TEST_P(Contact, RollsAsItsRollingFrictionLetsIt) {
  for (const double slope : {0.1, 0.2}) {
    Folder folder;
    EngineSetup setup = weightless(folder.path, law(), 0.5);
    setup.gravity = {slope * g, 0, -g};
    WorkerEngine engine(worker());
    engine.start(setup);
    AdvanceRequest request = steps(3000);
    request.insert = {grain(1, {d, 4 * d, 0.5 * d}, {0, 0, 0})};
    const Advanced a = engine.advance(request);
    const double time = 3000 * setup.timestep, rolling = law() == ContactLaw::hertz ? 0.15 : 0;
    const double speed = std::max(0.0, (slope - rolling) * g / 1.4 * time);  // 1.4 = 1 + 2/5 of a sphere
    EXPECT_NEAR(a.grains.vx[0], speed, 0.02 * slope * g * time) << "slope " << slope;
  }
}

TEST(ContactLaws, HaveNamesAndFitTheirRestitution) {
  for (const ContactLaw law : {ContactLaw::hertz, ContactLaw::kelvin_voigt}) EXPECT_EQ(contact_law(to_string(law)), law);
  EXPECT_THROW(contact_law("hooke"), std::invalid_argument);
  EXPECT_EQ(damping_ratio(1), 0);
  // A spring and damper, integrated finely until they part.
  for (const double asked : {0.1, 0.4, 0.8}) {
    const double D = damping_ratio(asked), step = 1e-5;
    double x = 0, v = 1;
    while (2 * D * v + x >= 0) {
      v -= step * (2 * D * v + x);
      x += step * v;
    }
    EXPECT_NEAR(-v, asked, 1e-4) << D;
  }
}

TEST(ContactLaws, AreToldApartByTheirDamping) {
  EXPECT_EQ(contact_name(ContactLaw::hertz, true), "hertz");
  EXPECT_EQ(contact_name(ContactLaw::kelvin_voigt, false), "kelvin_voigt-undamped");
}

// Both integrated finely, with x^(3/2) and x^(1/4) v, as LIGGGHTS has them, up to where the contact would pull and to its end.
TEST(ContactLaws, OfHertzReboundLessWhereTheyPull) {
  EXPECT_EQ(restitution_with_tension(1), 1);
  EXPECT_GT(restitution_with_tension(0.22), 0.05) << "the least that a scene may ask for, and LIGGGHTS takes";
  EXPECT_LT(restitution_with_tension(0.21), 0.05);
  for (const double asked : {0.22, 0.5, 0.9}) {
    const double D = damping_ratio(asked), c = std::sqrt(5.0) * D, step = 1e-6;  // of m x'' = -x^(3/2) - c x^(1/4) x'
    double x = 1e-9, v = 1, parted = 0;
    while (x > 0) {
      const double push = std::pow(x, 1.5) + c * std::pow(x, 0.25) * v;
      if (push < 0 && parted == 0) parted = -v;
      v -= step * push;
      x += step * v;
    }
    EXPECT_NEAR(parted, asked, 1e-3);
    EXPECT_NEAR(-v, restitution_with_tension(asked), 1e-3);
  }
}
