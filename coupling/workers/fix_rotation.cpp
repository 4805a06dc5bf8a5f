#include "coupling/workers/fix_rotation.hpp"

// clang-format off
#include <liggghts/fix_contact_history_mesh.h>
#include <liggghts/tri_mesh.h>
// clang-format on

namespace couloir {

namespace {

// Speed along the plane whose normal is `way`, of any length.
double along_plane(const double* way, const double* v) {
  const double vn = v[0] * way[0] + v[1] * way[1] + v[2] * way[2];
  const double vv = v[0] * v[0] + v[1] * v[1] + v[2] * v[2], nn = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
  return std::sqrt(nn > 0 ? std::max(0.0, vv - vn * vn / nn) : vv);
}

}  // namespace

FixRotation::FixRotation(LAMMPS_NS::LAMMPS* lmp, int n, char** words) : Fix(lmp, n, words) {}

void FixRotation::set(const EngineSetup& setup, std::vector<LAMMPS_NS::FixMeshSurface*> surfaces) {
  rule_ = setup.rotation;
  control_ = setup.control;
  surfaces_ = std::move(surfaces);
}

int FixRotation::setmask() {
  return LAMMPS_NS::FixConst::POST_FORCE;
}

// After a set-up of the engine torques are new, also of grains that slide. Time does not pass.
void FixRotation::setup(int) {
  hold_those_that_slide();
}

void FixRotation::post_force(int) {
  hold_those_that_slide();
  if (rule_ != Rotation::control) return;
  for (int i = 0; i < atom->nlocal; ++i) {
    if (contacts_[i] == 0) continue;
    const double factor = control_.factor(contacts_[i], control_.needs_shear() ? shear(i) : 0, update->dt);
    for (int k = 0; k < 3; ++k) atom->omega[i][k] *= factor;
  }
}

void FixRotation::hold(int i) {
  for (int k = 0; k < 3; ++k) atom->omega[i][k] = atom->torque[i][k] = 0;
}

void FixRotation::hold_those_that_slide() {
  if (rule_ == Rotation::blocked) {
    for (int i = 0; i < atom->nlocal; ++i) hold(i);
    return;
  }
  if (rule_ != Rotation::control) return;
  contacts_.assign(static_cast<std::size_t>(atom->nlocal), 0);
  shear_.assign(static_cast<std::size_t>(atom->nlocal), 0.0);
  count_grains();
  for (LAMMPS_NS::FixMeshSurface* surface : surfaces_) count_surfaces(*surface);
  if (control_.slide_to_roll == 0) return;
  for (int i = 0; i < atom->nlocal; ++i) {
    const double* w = atom->omega[i];
    const bool spins = w[0] != 0 || w[1] != 0 || w[2] != 0;
    if (contacts_[i] > 0 && control_.slides(spins, shear(i))) hold(i);
  }
}

// The list has each pair once, but pairs across ranks on either (newton off).
void FixRotation::count_grains() {
  const LAMMPS_NS::NeighList& list = *force->pair->list;
  double** const x = atom->x;
  double** const v = atom->v;
  for (int n = 0; n < list.inum; ++n) {
    const int i = list.ilist[n];
    for (int m = 0; m < list.numneigh[i]; ++m) {
      const int j = list.firstneigh[i][m] & NEIGHMASK;
      const double way[3] = {x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]};
      const double reach = atom->radius[i] + atom->radius[j];
      if (way[0] * way[0] + way[1] * way[1] + way[2] * way[2] >= reach * reach) continue;
      double speed = 0;
      if (control_.needs_shear()) {
        const double u[3] = {v[i][0] - v[j][0], v[i][1] - v[j][1], v[i][2] - v[j][2]};
        speed = along_plane(way, u);
      }
      ++contacts_[i];
      shear_[i] += speed;
      if (j >= atom->nlocal) continue;
      ++contacts_[j];
      shear_[j] += speed;
    }
  }
}

// The engine's own list of what touches what: of triangles in one plane a grain touches one.
void FixRotation::count_surfaces(LAMMPS_NS::FixMeshSurface& surface) {
  LAMMPS_NS::FixContactHistoryMesh& touching = *surface.contactHistory();
  LAMMPS_NS::TriMesh& mesh = *surface.triMesh();
  for (int i = 0; i < atom->nlocal; ++i) {
    if (touching.n_partner(i) == 0) continue;
    for (int m = 0; m < touching.nneighs(i); ++m) {
      const int triangle = touching.get_partner_idTri(i, m);
      if (triangle < 0) continue;
      ++contacts_[i];
      const int local = mesh.map(triangle, 0);
      if (!control_.needs_shear() || local < 0) continue;
      double way[3] = {};
      int place = 0;
      mesh.resolveTriSphereContact(i, local, atom->radius[i], atom->x[i], way, place);
      shear_[i] += along_plane(way, atom->v[i]);
    }
  }
}

}  // namespace couloir
