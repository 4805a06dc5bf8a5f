#include "coupling/workers/fix_drive.hpp"

#include <unordered_map>

namespace couloir {

namespace {

Vec vec(const double* x) {
  return {x[0], x[1], x[2]};
}

// What a velocity has along a face, in the direction that the face has elsewhere.
Vec turned(const Vec& velocity, const Vec& inward, const Vec& direction) {
  const double normal = dot(velocity, inward);
  Vec along;
  for (int k = 0; k < 3; ++k) along[k] = velocity[k] - normal * inward[k];
  const double speed = std::copysign(std::sqrt(dot(along, along)), dot(along, direction));
  Vec result;
  for (int k = 0; k < 3; ++k) result[k] = normal * inward[k] + speed * direction[k];
  return result;
}

}  // namespace

FixDrive::FixDrive(LAMMPS_NS::LAMMPS* lmp, int n, char** words) : Fix(lmp, n, words) {
  create_attribute = 1;
  grow_arrays(atom->nmax);
  atom->add_callback(0);
  for (int i = 0; i < atom->nlocal; ++i) raft_[i] = free_grain;
}

FixDrive::~FixDrive() {
  atom->delete_callback(id, 0);
  memory->destroy(raft_);
}

void FixDrive::set_faces(const std::vector<DriveFace>& faces, double edge) {
  faces_ = faces;
  edge_ = edge;
  first_raft_.clear();
  rafts_.clear();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    first_raft_.push_back(static_cast<int>(rafts_.size()));
    for (int s = 0; s < faces[f].segments; ++s) {
      rafts_.emplace_back();
      rafts_.back().face = static_cast<int>(f);
    }
  }
  sums_.resize(2 * rafts_.size());
}

void FixDrive::begin_window(const AdvanceRequest& request) {
  jump_ = {};
  taken_sum_ = {};
  taken_first_ = taken_;
  for (const RimMove& move : request.rim_moves) move_rim(move);
  std::size_t next = 0;
  for (const auto& face : request.drives) {
    for (const SegmentDrive& drive : face) rafts_[next++].drive = drive;
  }
  note_exits();
  regroup();
  for (Raft& raft : rafts_) {
    const SegmentDrive& d = raft.drive;
    raft.displacement = raft.force = 0;
    raft.velocity = raft.mass < d.least_mass || raft.mass <= 0 ? d.most : std::clamp(raft.velocity, d.least, d.most);
  }
  // The window's first drift is already at the new velocity.
  for (int i = 0; i < atom->nlocal; ++i) {
    if (raft_[i] == free_grain) continue;
    const Vec to = raft_velocity(raft_[i], vec(atom->x[i]));
    add_jump(atom->rmass[i], vec(atom->v[i]), to);
    for (int k = 0; k < 3; ++k) atom->v[i][k] = to[k];
  }
}

void FixDrive::move_rim(const RimMove& move) {
  for (int i = 0; i < atom->nlocal; ++i)
    if (raft_[i] != free_grain) release(i);
  set_faces(move.faces, edge_);
  std::unordered_map<int, int> raft_of_grain;
  for (const Regrouped& g : move.driven) raft_of_grain[static_cast<int>(g.id)] = raft_of(g.face, g.segment);
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (int i = 0; i < atom->nlocal; ++i) {
    const auto found = raft_of_grain.find(atom->tag[i]);
    if (found == raft_of_grain.end()) continue;
    const std::size_t r = static_cast<std::size_t>(raft_[i] = found->second);
    const DriveFace& face = faces_[static_cast<std::size_t>(rafts_[r].face)];
    sums_[2 * r] += atom->rmass[i] * dot(face.inward, vec(atom->v[i]));
    sums_[2 * r + 1] += atom->rmass[i];
    for (int k = 0; k < 3; ++k) {
      taken_first_[k] += atom->f[i][k];  // the half kick that this step will not give it
      atom->f[i][k] = atom->omega[i][k] = atom->torque[i][k] = 0;
    }
  }
  if (comm->nprocs > 1) MPI_Allreduce(MPI_IN_PLACE, sums_.data(), static_cast<int>(sums_.size()), MPI_DOUBLE, MPI_SUM, world);
  for (std::size_t r = 0; r < rafts_.size(); ++r) {
    rafts_[r].mass = sums_[2 * r + 1];
    if (rafts_[r].mass > 0) rafts_[r].velocity = sums_[2 * r] / rafts_[r].mass;
  }
}

// What has slid into another segment goes on with that one's raft.
void FixDrive::regroup() {
  if (std::none_of(rafts_.begin(), rafts_.end(), [](const Raft& raft) { return raft.drive.slide != 0; })) return;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (raft_[i] == free_grain || rafts_[static_cast<std::size_t>(raft_[i])].drive.slide == 0) continue;
    const int f = rafts_[static_cast<std::size_t>(raft_[i])].face;
    const DriveFace& face = faces_[static_cast<std::size_t>(f)];
    raft_[i] = raft_of(f, segment_at(face, place_on(face, vec(atom->x[i])).along));
  }
  std::vector<double> mass(rafts_.size(), 0.0);
  for (int i = 0; i < atom->nlocal; ++i)
    if (raft_[i] != free_grain) mass[static_cast<std::size_t>(raft_[i])] += atom->rmass[i];
  if (comm->nprocs > 1) MPI_Allreduce(MPI_IN_PLACE, mass.data(), static_cast<int>(mass.size()), MPI_DOUBLE, MPI_SUM, world);
  for (std::size_t r = 0; r < rafts_.size(); ++r) rafts_[r].mass = mass[r];
}

void FixDrive::note_exits() {
  any_exit_ = std::any_of(rafts_.begin(), rafts_.end(), [](const Raft& raft) { return raft.drive.exit_active; });
}

Vec FixDrive::raft_velocity(int r, const Vec& at) const {
  const Raft& raft = rafts_[static_cast<std::size_t>(r)];
  const DriveFace& face = faces_[static_cast<std::size_t>(raft.face)];
  const PlaceOnFace place = place_on(face, at);
  const double along = raft.drive.slide * place.pace;
  Vec v;
  for (int k = 0; k < 3; ++k) v[k] = raft.velocity * face.inward[k] + along * place.direction[k];
  return v;
}

Vec FixDrive::impulse() const {
  Vec result;
  for (int k = 0; k < 3; ++k) result[k] = jump_[k] - update->dt * (taken_sum_[k] + 0.5 * (taken_first_[k] - taken_[k]));
  return result;
}

void FixDrive::add_jump(double mass, const Vec& from, const Vec& to) {
  for (int k = 0; k < 3; ++k) jump_[k] += mass * (to[k] - from[k]);
}

int FixDrive::setmask() {
  return LAMMPS_NS::FixConst::POST_FORCE;
}

// After a set-up of the engine (at the start, after a checkpoint) forces are new and velocities are as they were.
void FixDrive::setup(int) {
  const Vec jump = jump_;
  taken_ = {};
  set_velocities();
  jump_ = jump;
}

void FixDrive::post_force(int) {
  taken_ = {};
  if (rafts_.empty()) return;
  release_and_sum();
  move_rafts();
  set_velocities();
  for (int k = 0; k < 3; ++k) taken_sum_[k] += taken_[k];
}

int FixDrive::segment_at(const DriveFace& face, double along) {
  return std::clamp(static_cast<int>(std::floor(along / face.segment_width)), 0, face.segments - 1);
}

void FixDrive::release(int i) {
  const Raft& raft = rafts_[static_cast<std::size_t>(raft_[i])];
  const DriveFace& face = faces_[static_cast<std::size_t>(raft.face)];
  raft_[i] = free_grain;
  const Vec direction = place_on(face, vec(atom->x[i])).direction;
  Vec freed;
  for (int k = 0; k < 3; ++k) freed[k] = raft.velocity * face.inward[k] + raft.drive.along * direction[k];
  add_jump(atom->rmass[i], vec(atom->v[i]), freed);
  std::copy(freed.begin(), freed.end(), atom->v[i]);
}

void FixDrive::release_and_sum() {
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (int i = 0; i < atom->nlocal; ++i) {
    if (raft_[i] == free_grain) continue;
    const std::size_t r = static_cast<std::size_t>(raft_[i]);
    const DriveFace& face = faces_[static_cast<std::size_t>(rafts_[r].face)];
    if (distance(face, vec(atom->x[i])) >= 0) {
      release(i);
      continue;
    }
    sums_[2 * r] += dot(face.inward, vec(atom->f[i]));
    sums_[2 * r + 1] += atom->rmass[i];
  }
  if (comm->nprocs > 1) {
    MPI_Allreduce(MPI_IN_PLACE, sums_.data(), static_cast<int>(sums_.size()), MPI_DOUBLE, MPI_SUM, world);
  }
}

void FixDrive::move_rafts() {
  const double dt = update->dt;
  for (std::size_t r = 0; r < rafts_.size(); ++r) {
    Raft& raft = rafts_[r];
    const SegmentDrive& d = raft.drive;
    raft.displacement += raft.velocity * dt;  // this step's drift
    raft.force += sums_[2 * r];
    raft.mass = sums_[2 * r + 1];
    if (raft.mass < d.least_mass || raft.mass <= 0) {
      raft.velocity = d.most;
    } else {
      raft.velocity = std::clamp(raft.velocity + dt * (sums_[2 * r] + d.push) / raft.mass, d.least, d.most);
    }
  }
}

void FixDrive::set_velocities() {
  Vec exit;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (raft_[i] != free_grain) {
      hold(i, raft_velocity(raft_[i], vec(atom->x[i])));
    } else if (any_exit_ && strip_velocity(atom->x[i], exit)) {
      hold(i, exit);
    }
  }
}

bool FixDrive::strip_velocity(const double* x, Vec& velocity) const {
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const DriveFace& face = faces_[f];
    const double d = distance(face, vec(x));
    if (d < -face.strip_end || d > -face.strip_begin) continue;
    const PlaceOnFace place = place_on(face, vec(x));
    const double s = place.along;
    if (s < -edge_ || s > face.segments * face.segment_width + edge_) continue;
    const int segment = segment_at(face, s);
    const SegmentDrive& drive = rafts_[static_cast<std::size_t>(raft_of(static_cast<int>(f), segment))].drive;
    if (!drive.exit_active) continue;
    velocity = face.bend.length == 0 ? drive.exit_velocity : turned(drive.exit_velocity, face.inward, place.direction);
    return true;
  }
  return false;
}

void FixDrive::hold(int i, const Vec& velocity) {
  double *v = atom->v[i], *f = atom->f[i], *w = atom->omega[i], *t = atom->torque[i];
  for (int k = 0; k < 3; ++k) {
    jump_[k] += atom->rmass[i] * (velocity[k] - v[k]);
    taken_[k] += f[k];
    v[k] = velocity[k];
    f[k] = w[k] = t[k] = 0;
  }
}

void FixDrive::grow_arrays(int nmax) {
  memory->grow(raft_, nmax, "couloir/drive:raft");
}
void FixDrive::copy_arrays(int from, int to, int) {
  raft_[to] = raft_[from];
}
void FixDrive::set_arrays(int i) {
  raft_[i] = free_grain;
}

int FixDrive::pack_exchange(int i, double* buffer) {
  buffer[0] = raft_[i];
  return 1;
}

int FixDrive::unpack_exchange(int i, double* buffer) {
  raft_[i] = static_cast<int>(buffer[0]);
  return 1;
}

}  // namespace couloir
