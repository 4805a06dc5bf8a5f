#pragma once
// Rafts and exit strips of the rim faces (coupling/engine/grain_engine.hpp), every step, after all forces.
//
//   x += dt v                                     the step's drift, with the velocity set a step ago
//   f  = contacts + weight
//   release     distance >= 0: free for good
//   raft        u <- u + dt (sum f.n + push) / m, clipped to [least, most]
//   set         v = u n + slide along; f, torque, spin = 0: the integrator's kicks do nothing
//
// Which raft a grain belongs to is kept with the grain and moves with it between ranks.

#include <cstdint>
#include <utility>
#include <vector>

#include "coupling/engine/drive_face.hpp"
#include "coupling/workers/engine_headers.hpp"

namespace couloir {

class FixDrive : public LAMMPS_NS::Fix {
 public:
  static constexpr int free_grain = -1;

  struct Raft {
    int face = 0;
    SegmentDrive drive;
    double velocity = 0;      // [m/s]
    double mass = 0;          // [kg] at the last step
    double displacement = 0;  // [m] in this window
    double force = 0;         // [N] summed over the window's steps
  };

  FixDrive(LAMMPS_NS::LAMMPS*, int, char**);
  ~FixDrive() override;

  void set_faces(const std::vector<DriveFace>&, double edge);  // edge [m]: a strip reaches so far past its face's ends
  void begin_window(const AdvanceRequest&);
  void note_exits();  // after drives were set through rafts()

  int raft_of(int face, int segment) const { return first_raft_[static_cast<std::size_t>(face)] + segment; }
  Vec raft_velocity(int raft, const Vec& at) const;  // [m/s] of its grain there
  int& of_grain(int local) { return raft_[local]; }  // free_grain, or its raft
  std::vector<Raft>& rafts() { return rafts_; }
  const std::vector<DriveFace>& faces() const { return faces_; }

  // [N s] that setting velocities gave to this rank's grains beyond the forces that it took away, in this window.
  Vec impulse() const;
  void add_jump(double mass, const Vec& from, const Vec& to);  // a velocity that others set for a raft's sake

  int setmask() override;
  void setup(int) override;
  void post_force(int) override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double*) override;
  int unpack_exchange(int, double*) override;

 private:
  static int segment_at(const DriveFace&, double along);
  void move_rim(const RimMove&);
  void regroup();
  void release(int local);
  void release_and_sum();
  void move_rafts();
  void set_velocities();
  bool strip_velocity(const double* x, Vec& velocity) const;
  void hold(int local, const Vec& velocity);

  int* raft_ = nullptr;  // by local grain
  std::vector<DriveFace> faces_;
  std::vector<int> first_raft_;
  std::vector<Raft> rafts_;
  std::vector<double> sums_;  // by raft: force along the normal, mass
  double edge_ = 0;
  bool any_exit_ = false;
  Vec jump_{};                                 // [N s] of set velocities
  Vec taken_first_{}, taken_{}, taken_sum_{};  // [N] forces taken away: before the window, at the last step, summed
};

}  // namespace couloir
