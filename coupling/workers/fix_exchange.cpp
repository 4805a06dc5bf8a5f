#include "coupling/workers/fix_exchange.hpp"

#include <numbers>

namespace couloir {

FixExchange::FixExchange(LAMMPS_NS::LAMMPS* lmp, int n, char** words) : Fix(lmp, n, words) {
  if (n != 4) error->all(FLERR, "fix couloir/exchange needs the largest radius");
  max_radius_ = std::atof(words[3]);
  force_reneighbor = 1;
  next_reneighbor = -1;
}

int FixExchange::setmask() {
  return LAMMPS_NS::FixConst::PRE_EXCHANGE;
}

void FixExchange::set(Order order, FixDrive* drive) {
  order_ = std::move(order);
  drive_ = drive;
  impulse_ = {};
  if (!order_.insert.empty() || !order_.remove.empty()) next_reneighbor = update->ntimestep + 1;
}

void FixExchange::pre_exchange() {
  if (update->ntimestep != next_reneighbor) return;
  next_reneighbor = -1;
  const long before = atom->nlocal;
  remove();
  insert();
  long change = atom->nlocal - before;
  MPI_Allreduce(MPI_IN_PLACE, &change, 1, MPI_LONG, MPI_SUM, world);
  const long asked = static_cast<long>(order_.insert.size()) - static_cast<long>(order_.remove.size());
  if (change != asked) error->all(FLERR, "the number of grains put in and taken out is not the number asked for");
  atom->natoms += change;
  atom->tag_extend();
  if (atom->map_style) {
    atom->nghost = 0;
    atom->map_init();
    atom->map_set();
  }
  order_ = {};
}

void FixExchange::remove() {
  if (order_.remove.empty()) return;
  const auto leaves = [&](int i) { return std::binary_search(order_.remove.begin(), order_.remove.end(), atom->tag[i]); };
  // Forces stay where they are when grains are moved up below: sum first.
  for (int i = 0; i < atom->nlocal; ++i) {
    if (!leaves(i)) continue;
    for (int k = 0; k < 3; ++k) impulse_[k] += 0.5 * update->dt * (atom->rmass[i] * order_.gravity[k] - atom->f[i][k]);
  }
  for (int i = 0; i < atom->nlocal;) {
    if (leaves(i)) {
      atom->avec->copy(--atom->nlocal, i, 1);
    } else {
      ++i;
    }
  }
}

bool FixExchange::mine(const double* x) const {
  for (int k = 0; k < 3; ++k) {
    const bool first = comm->myloc[k] == 0, last = comm->myloc[k] == comm->procgrid[k] - 1;
    if (!(first || x[k] >= domain->sublo[k]) || !(last || x[k] < domain->subhi[k])) return false;
  }
  return true;
}

void FixExchange::insert() {
  const double dt = update->dt;
  for (const NewGrain& grain : order_.insert) {
    const int raft = grain.segment < 0 ? FixDrive::free_grain : drive_->raft_of(grain.face, grain.segment);
    Vec v = raft == FixDrive::free_grain ? grain.velocity : drive_->raft_velocity(raft, grain.position);
    double x[3];
    for (int k = 0; k < 3; ++k) {
      if (raft == FixDrive::free_grain) v[k] += 0.5 * dt * order_.gravity[k];
      x[k] = grain.position[k] + dt * v[k];
    }
    domain->remap(x);
    if (!mine(x)) continue;
    atom->avec->create_atom(1, x);
    const int i = atom->nlocal - 1;
    atom->tag[i] = static_cast<int>(grain.id);
    atom->mask[i] = 1 | groupbit;
    atom->radius[i] = grain.radius;
    atom->density[i] = order_.density;
    atom->rmass[i] = 4.0 / 3.0 * std::numbers::pi * grain.radius * grain.radius * grain.radius * order_.density;
    for (int k = 0; k < 3; ++k) {
      atom->v[i][k] = v[k];
      atom->omega[i][k] = raft == FixDrive::free_grain ? grain.spin[k] : 0;
    }
    for (int j = 0; j < modify->nfix; ++j) {
      if (!modify->fix[j]->create_attribute) continue;
      modify->fix[j]->pre_set_arrays();
      modify->fix[j]->set_arrays(i);
    }
    drive_->of_grain(i) = raft;
    if (raft != FixDrive::free_grain) {
      drive_->add_jump(atom->rmass[i], grain.velocity, v);
      for (int k = 0; k < 3; ++k) impulse_[k] -= 0.5 * dt * atom->rmass[i] * order_.gravity[k];
    }
  }
}

}  // namespace couloir
