// What a session reports after an advance: sums over all ranks, and the grains.
#include <numeric>

#include "coupling/workers/liggghts_session.hpp"

namespace couloir {

void Session::report_surfaces(Advanced& result) const {
  const std::size_t surfaces = setup_.surfaces.size();
  std::vector<double> sums;  // per surface: mean, last; then the impulse of driving; then the samples surface by surface
  for (std::size_t k = 0; k < surfaces; ++k) {
    const Vec mean = probe_->mean(k), last = probe_->last(k);
    sums.insert(sums.end(), mean.begin(), mean.end());
    sums.insert(sums.end(), last.begin(), last.end());
  }
  const Vec driving = drive_->impulse(), exchange = exchange_->impulse();
  for (int c = 0; c < 3; ++c) sums.push_back(driving[c] + exchange[c]);
  for (const double f : zone_force_->mean()) sums.push_back(f);
  for (std::size_t k = 0; k < surfaces; ++k)
    for (const Vec& sample : probe_->samples(k)) sums.insert(sums.end(), sample.begin(), sample.end());
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, comm_);
  for (std::size_t k = 0; k < surfaces; ++k) {
    result.surface_force.push_back({sums[6 * k], sums[6 * k + 1], sums[6 * k + 2]});
    result.surface_force_last.push_back({sums[6 * k + 3], sums[6 * k + 4], sums[6 * k + 5]});
  }
  for (int c = 0; c < 3; ++c) result.drive_impulse[c] = sums[6 * surfaces + c];
  for (int c = 0; c < 3; ++c) result.zone_force[c] = sums[6 * surfaces + 3 + c];
  if (setup_.faces.empty()) {
    result.zone_force = {};
    for (const Vec& force : result.surface_force)
      for (int c = 0; c < 3; ++c) result.zone_force[c] -= force[c];
  }
  const double* next = sums.data() + 6 * surfaces + 6;
  for (std::size_t k = 0; k < surfaces; ++k) {
    auto& samples = result.surface_force_samples.emplace_back(probe_->samples(k).size());
    for (Vec& sample : samples) std::copy_n(next, 3, sample.begin()), next += 3;
  }
}

void Session::report_segments(Advanced& result, std::int64_t steps) const {
  const auto& rafts = drive_->rafts();
  std::size_t next = 0;
  for (const DriveFace& face : setup_.faces) {
    auto& reports = result.segments.emplace_back();
    for (int s = 0; s < face.segments; ++s) {
      const FixDrive::Raft& raft = rafts[next++];
      reports.push_back({raft.displacement, raft.velocity, steps > 0 ? raft.force / static_cast<double>(steps) : 0.0, raft.mass});
    }
  }
}

void Session::report_energy_and_overlap(Advanced& result) const {
  const LAMMPS_NS::Atom& atom = *engine_->atom;
  double energy = 0;
  for (int i = 0; i < atom.nlocal; ++i) {
    const double *v = atom.v[i], *w = atom.omega[i], r = atom.radius[i];
    energy +=
        0.5 * atom.rmass[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + 0.4 * r * r * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]));
  }
  double overlap = 0;
  const LAMMPS_NS::Pair* pair = engine_->force->pair_match("gran", 1);
  if (const LAMMPS_NS::NeighList* list = pair ? pair->list : nullptr; list && grains_ > 0) {
    for (int ii = 0; ii < list->inum; ++ii) {
      const int i = list->ilist[ii];
      if (i >= atom.nlocal) continue;
      for (int jj = 0; jj < list->numneigh[i]; ++jj) {
        const int j = list->firstneigh[i][jj] & NEIGHMASK;
        const double dx = atom.x[i][0] - atom.x[j][0], dy = atom.x[i][1] - atom.x[j][1], dz = atom.x[i][2] - atom.x[j][2];
        const double reach = atom.radius[i] + atom.radius[j], square = dx * dx + dy * dy + dz * dz;
        if (square < reach * reach) overlap = std::max(overlap, (reach - std::sqrt(square)) / reach);
      }
    }
  }
  MPI_Allreduce(MPI_IN_PLACE, &energy, 1, MPI_DOUBLE, MPI_SUM, comm_);
  MPI_Allreduce(MPI_IN_PLACE, &overlap, 1, MPI_DOUBLE, MPI_MAX, comm_);
  result.kinetic_energy = energy;
  result.max_overlap = overlap;
}

void Session::gather_grains(Grains& grains) const {
  constexpr int width = 9;
  const LAMMPS_NS::Atom& atom = *engine_->atom;
  std::vector<double> rows;
  rows.reserve(static_cast<std::size_t>(atom.nlocal) * width);
  for (int i = 0; i < atom.nlocal; ++i) {
    double x[3] = {atom.x[i][0], atom.x[i][1], atom.x[i][2]};
    engine_->domain->remap(x);  // periodic axes: into the box
    const double* v = atom.v[i];
    const double driven = drive_->of_grain(i) == FixDrive::free_grain ? 0.0 : 1.0;
    rows.insert(rows.end(), {static_cast<double>(atom.tag[i]), x[0], x[1], x[2], v[0], v[1], v[2], atom.radius[i], driven});
  }
  if (ranks_ > 1) {
    const int mine = static_cast<int>(rows.size());
    std::vector<int> counts(static_cast<std::size_t>(ranks_)), offsets(static_cast<std::size_t>(ranks_));
    MPI_Gather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, comm_);
    std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
    std::vector<double> all(rank_ == 0 ? static_cast<std::size_t>(offsets.back() + counts.back()) : 0);
    MPI_Gatherv(rows.data(), mine, MPI_DOUBLE, all.data(), counts.data(), offsets.data(), MPI_DOUBLE, 0, comm_);
    rows = std::move(all);
  }
  if (rank_ != 0) return;
  const std::size_t n = rows.size() / width;
  std::vector<std::pair<std::int64_t, std::size_t>> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = {static_cast<std::int64_t>(rows[i * width]), i};
  std::sort(order.begin(), order.end());
  for (auto* column : {&grains.x, &grains.y, &grains.z, &grains.vx, &grains.vy, &grains.vz, &grains.radius}) column->resize(n);
  grains.id.resize(n);
  grains.driven.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double* row = &rows[order[i].second * width];
    grains.id[i] = order[i].first;
    grains.x[i] = row[1];
    grains.y[i] = row[2];
    grains.z[i] = row[3];
    grains.vx[i] = row[4];
    grains.vy[i] = row[5];
    grains.vz[i] = row[6];
    grains.radius[i] = row[7];
    grains.driven[i] = row[8] != 0 ? 1 : 0;
  }
}

}  // namespace couloir
