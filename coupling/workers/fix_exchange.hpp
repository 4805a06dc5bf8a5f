#pragma once
// Puts grains in and takes grains out at the start of a run's first step, in pre_exchange: the other grains keep their bits and
// their contacts.
//
//   initial_integrate -> pre_exchange (here) -> exchange, borders, neighbour lists -> forces -> final_integrate
//
// The step's drift is over by then, so a new grain is given that drift itself: as if it had been there under gravity alone
// (free), or with its raft (driven).

#include <vector>

#include "coupling/workers/fix_drive.hpp"

namespace couloir {

class FixExchange : public LAMMPS_NS::Fix {
 public:
  FixExchange(LAMMPS_NS::LAMMPS*, int, char**);  // fix ID all couloir/exchange MAX_RADIUS

  struct Order {  // the same on every rank
    std::vector<NewGrain> insert;
    std::vector<int> remove;  // sorted
    double density = 0;       // [kg/m3]
    Vec gravity{};            // [m/s2]
  };
  void set(Order, FixDrive*);

  // [N s] of this rank in this window: momentum that removed grains had got since their last report and that new driven grains
  // did not get, with gravity left out.
  Vec impulse() const { return impulse_; }

  int setmask() override;
  void pre_exchange() override;
  double max_rad(int) override { return max_radius_; }  // sets the lists' cut-off while there are no grains yet
  double min_rad(int) override { return 0; }
  int min_type() override { return 1; }  // likewise for the types
  int max_type() override { return atom->ntypes; }

 private:
  void remove();
  void insert();
  bool mine(const double* x) const;

  Order order_;
  FixDrive* drive_ = nullptr;
  double max_radius_ = 0;
  Vec impulse_{};
};

}  // namespace couloir
