#pragma once
// RUN/flow.xdmf and RUN/grains.xdmf: what ParaView opens. Both only refer to records.h5, so they must stay beside it.
//
//   flow     the free surface as a curvilinear sheet through the cell centres: depth, momentum along and across, velocity
//   grains   points: radius, velocity, driven, id (use the Point Gaussian view or a Glyph with sphere scaled by radius)
//
// Complete after every frame. Attach it behind Records, whose flush makes the data it refers to.

#include <optional>
#include <string>

#include "coupling/loop/observer.hpp"
#include "coupling/records/text_file.hpp"

namespace couloir {

class Xdmf : public Observer {
 public:
  // `folder`: of the run. A file is made with the first frame that has something for it. Throws RecordError.
  explicit Xdmf(const std::string& folder) : folder_(folder) {}
  void on_start(const RunStart&) override;
  void on_frame(const FrameView&) override;
  void state(Archive&) override;

 private:
  std::string path_of(const std::string& name) const { return folder_ + "/" + name + ".xdmf"; }
  void add(std::optional<TextFile>& file, const std::string& name, const std::string& grid);

  std::string folder_;
  Grid grid_;
  std::optional<TextFile> flow_, grains_;
};

}  // namespace couloir
