#pragma once
// What every scene must hold, step by step, and the worst figures met.
//
//   depth    never below zero, none clipped, every number finite
//   mass     |V - V0 - what entered| / (V0 + what passed the sides)
//   energy   E = sum of h |u|^2 / 2 + K0 g cos(zeta) h^2 / 2 + g cos(zeta) h z + g h Z; z: the bed with its steps, Z: the height
//            of the reference surface, both from their lowest point, so that what flows out takes energy along.
//            K0 = max(1, K_act): as K_act <= K0 <= K_pas and K_y,act <= K0 <= K_y,pas, the earth pressure takes at least as much
//            from a compressed flow as the potential gains, and gives a stretched one at most as much: in the equations E never
//            grows. Three things feed it: the weight's change along an arc and the ramp of K (decision 0004), both counted off;
//            and the cells: the place of material within a cell is not resolved. So growth is given in units of the weight of
//            all material times the greatest drop over one cell (plus 1e-6 of the start's energy, 1e-4 with scheme noc).
//   speed    |u| over |u0| + 4 sqrt(K g h) of the deepest flow so far + 2 sqrt(2 g dz) + g sin(zeta) (t + 2 dt)

#include "case.hpp"

namespace couloir::test {

struct Worst {
  double mass = 0, energy = 0, speed = 0;
  double least = 0;    // least depth over the deepest
  double clipped = 0;  // volume relative to the start's
  bool finite = true;
  void take(const Worst&);
};

// Above this K_pas (phi about 65 deg) the jump of the pressure between a passive and an active cell feeds E measurably; no
// granular material has it, and no energy is demanded there.
constexpr double stiffest = 20;

struct Bounds {
  double energy = 2, speed = 1;
};

class Demands {
 public:
  Demands(const Case&, const Subject&, FlowModel&);  // the subject that made the solver
  void step(double dt);                              // steps the solver, then looks
  void run(int steps);                               // that many stable steps
  const Worst& worst() const { return worst_; }
  // Expects all of the above and adds the figures to those of this test case.
  void expect(const std::string& what, const Bounds& = {});

 private:
  void look(double dt);
  double energy() const;
  double stored(int i, int j) const;
  double supply() const;

  const Case& case_;
  const Subject& subject_;
  FlowModel& solver_;
  bool has_energy_;
  double k0_, k_most_;
  std::vector<double> height_;        // of the reference surface by column, from its lowest [m]
  std::vector<double> weight_, arc_;  // g cos(zeta); g sin(zeta) kappa [m/s2], [1/s2] by column
  std::vector<double> bed_;           // with steps, from its lowest [m]
  std::vector<double> h_, hu_, hv_;
  double volume0_, passed_ = 0, mass_in_ = 0, u0_ = 0, drop_ = 0, drive_ = 0, deepest_ = 0, e0_, least_e_, supply_ = 0,
                   power_ = 0, cell_drop_ = 0;
  int seam_ = -1;
  Worst worst_;
};

// Whether the twin, run on the mirrored case, has the mirrored bits.
bool same_mirrored(const FlowModel&, const FlowModel& twin);

}  // namespace couloir::test
