#include "coupling/records/h5.hpp"

#include <algorithm>
#include <cstring>

#include "coupling/records/h5_driver.hpp"

namespace couloir::h5 {
namespace {

constexpr hsize_t kSeriesChunk = 1024;
constexpr hsize_t kSmall = 64;  // elements: below it a chunk index costs more than deflating gains

// The system's own words lie deepest in HDF5's error stack: "... error message = 'No space left on device', buf = ...".
herr_t find_reason(unsigned, const H5E_error2_t* entry, void* out) {
  auto& reason = *static_cast<std::string*>(out);
  const std::string text = entry->desc ? entry->desc : "";
  const auto at = text.find("error message = '");
  if (at != std::string::npos) {
    const auto begin = at + std::strlen("error message = '");
    reason = text.substr(begin, text.find('\'', begin) - begin);
  } else if (reason.empty()) {
    reason = text;
  }
  return 0;
}

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), "a text type could not be made");
  check(H5Tset_size(type, H5T_VARIABLE), "a text type could not be made");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "a text type could not be made");
  return type;
}

std::string path_of(hid_t object) {
  char file[512] = "";
  H5Fget_name(object, file, sizeof file);
  return file;
}

std::string writing(hid_t object) {
  return path_of(object) + " could not be written";
}
std::string reading(hid_t object, const std::string& name) {
  return path_of(object) + ": " + name + " could not be read";
}

// "frames/000003/h" from the file's root on.
std::string place_of(hid_t parent, const std::string& name) {
  char group[512] = "";
  H5Iget_name(parent, group, sizeof group);
  const std::string above = std::string(group).erase(0, 1);  // without the root's bar
  return above.empty() ? name : above + "/" + name;
}

void require(hid_t parent, const char* what, const std::string& name) {
  if (exists(parent, name)) return;
  throw RecordError(path_of(parent) + " is damaged: it has no " + what + " " + place_of(parent, name));
}

void put_meaning(hid_t set, const Meaning& meaning) {
  put_attribute(set, "unit", meaning.unit);
  put_attribute(set, "description", meaning.description);
}

Handle scalar_space() {
  return Handle(H5Screate(H5S_SCALAR), "a dataspace could not be made");
}

void put_attribute(hid_t object, const std::string& name, hid_t type, const void* value) {
  const std::string doing = writing(object);
  if (H5Aexists(object, name.c_str()) > 0) check(H5Adelete(object, name.c_str()), doing);
  const Handle space = scalar_space();
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), doing);
  check(H5Awrite(attribute, type, value), doing);
}

Handle open_or_create_series(hid_t parent, const std::string& name, hid_t type, const Meaning& meaning, hsize_t& rows) {
  const std::string doing = writing(parent);
  rows = 0;
  if (exists(parent, name)) {
    rows = shape_of(parent, name).at(0);
    return Handle(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), doing);
  }
  const hsize_t none = 0, unlimited = H5S_UNLIMITED, chunk = kSeriesChunk;
  const Handle space(H5Screate_simple(1, &none, &unlimited), doing);
  const Handle plist(H5Pcreate(H5P_DATASET_CREATE), doing);
  check(H5Pset_chunk(plist, 1, &chunk), doing);
  check(H5Pset_deflate(plist, 1), doing);
  Handle set(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, plist, H5P_DEFAULT), doing);
  put_meaning(set, meaning);
  return set;
}

void append(hid_t set, hid_t type, const void* data, hsize_t count, hsize_t& rows) {
  if (count == 0) return;
  const std::string doing = writing(set);
  const hsize_t size = rows + count;
  check(H5Dset_extent(set, &size), doing);
  const Handle file_space(H5Dget_space(set), doing);
  check(H5Sselect_hyperslab(file_space, H5S_SELECT_SET, &rows, nullptr, &count, nullptr), doing);
  const Handle memory(H5Screate_simple(1, &count, nullptr), doing);
  check(H5Dwrite(set, type, memory, file_space, H5P_DEFAULT, data), doing);
  rows = size;
}

// Metadata stay in memory until flush(): between two of them the file on disk hangs together for those who look.
Handle access_through(UndoJournal& journal, const std::string& doing) {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), doing);
  H5AC_cache_config_t cache;
  cache.version = H5AC__CURR_CACHE_CONFIG_VERSION;
  check(H5Pget_mdc_config(access, &cache), doing);
  cache.evictions_enabled = false;
  cache.incr_mode = H5C_incr__off;
  cache.flash_incr_mode = H5C_flash_incr__off;
  cache.decr_mode = H5C_decr__off;
  check(H5Pset_mdc_config(access, &cache), doing);
  check(use_journal(access, journal), doing);
  return access;
}

template <class T>
std::vector<T> read(hid_t parent, const std::string& name) {
  const std::string doing = reading(parent, name);
  require(parent, "dataset", name);
  const Handle set(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), doing);
  const Handle space(H5Dget_space(set), doing);
  std::vector<T> data(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  if (!data.empty()) check(H5Dread(set, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, data.data()), doing);
  return data;
}

}  // namespace

// HDF5 prints its error stack to stderr and cleans up at exit by itself; neither suits a program that reports its own errors.
void set_up_library() {
  static const bool once = [] {
    H5dont_atexit();
    H5open();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  (void)once;
}

Handle::Handle(hid_t id, const std::string& doing) : id_(id) {
  if (id < 0) check(-1, doing);
}

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    reset();
    id_ = std::exchange(other.id_, H5I_INVALID_HID);
  }
  return *this;
}

void Handle::reset() noexcept {
  if (id_ >= 0) H5Idec_ref(id_);
  id_ = H5I_INVALID_HID;
}

void check(herr_t status, const std::string& doing) {
  if (status >= 0) return;
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_reason, &reason);
  H5Eclear2(H5E_DEFAULT);
  if (reason.empty()) reason = "HDF5 gives no reason";
  throw RecordError(doing + ": " + reason);
}

Handle create_file(const std::string& path, UndoJournal& journal) {
  set_up_library();
  const std::string doing = path + " could not be written";
  return Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access_through(journal, doing)), doing);
}

Handle open_file(const std::string& path, UndoJournal& journal) {
  set_up_library();
  const std::string doing = path + " could not be opened";
  return Handle(H5Fopen(path.c_str(), H5F_ACC_RDWR, access_through(journal, doing)), doing);
}

Handle create_file(const std::string& path) {
  set_up_library();
  return Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), path + " could not be written");
}

Handle open_file(const std::string& path) {
  set_up_library();
  return Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), path + " could not be opened");
}

void flush(hid_t file, const std::string& path) {
  check(H5Fflush(file, H5F_SCOPE_LOCAL), path + " could not be written");
}

Handle create_group(hid_t parent, const std::string& name) {
  if (exists(parent, name)) return Handle(H5Gopen2(parent, name.c_str(), H5P_DEFAULT), writing(parent));
  return Handle(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), writing(parent));
}

Handle open_group(hid_t parent, const std::string& name) {
  require(parent, "group", name);
  return Handle(H5Gopen2(parent, name.c_str(), H5P_DEFAULT), reading(parent, name));
}

bool exists(hid_t parent, const std::string& name) {
  return H5Lexists(parent, name.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> children(hid_t parent) {
  H5G_info_t info;
  check(H5Gget_info(parent, &info), path_of(parent) + " could not be read");
  std::vector<std::string> names;
  for (hsize_t k = 0; k < info.nlinks; ++k) {
    char name[256] = "";
    H5Lget_name_by_idx(parent, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT);
    names.emplace_back(name);
  }
  return names;
}

void put_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Handle type = text_type();
  const char* text = value.c_str();
  put_attribute(object, name, type, &text);
}

void put_attribute(hid_t object, const std::string& name, double value) {
  put_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
}

void put_attribute(hid_t object, const std::string& name, std::int64_t value) {
  put_attribute(object, name, H5T_NATIVE_INT64, &value);
}

void put_attributes(hid_t object, const std::vector<std::pair<std::string, std::string>>& texts) {
  for (const auto& [name, value] : texts) put_attribute(object, name, value);
}

bool has_attribute(hid_t object, const std::string& name) {
  return H5Aexists(object, name.c_str()) > 0;
}

std::string text_attribute(hid_t object, const std::string& name) {
  const std::string doing = reading(object, name);
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), doing);
  const Handle type = text_type();
  char* text = nullptr;
  check(H5Aread(attribute, type, &text), doing);
  std::string value = text ? text : "";
  H5free_memory(text);
  return value;
}

double number_attribute(hid_t object, const std::string& name) {
  const std::string doing = reading(object, name);
  const Handle attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT), doing);
  double value = 0;
  check(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), doing);
  return value;
}

void put(hid_t parent, const std::string& name, hid_t type, const void* data, const Shape& shape, const Meaning& meaning) {
  const std::string doing = writing(parent);
  hsize_t count = 1;
  for (const hsize_t n : shape) count *= n;
  const Handle space = shape.empty() ? scalar_space() : Handle(H5Screate_simple(int(shape.size()), shape.data(), nullptr), doing);
  const Handle plist(H5Pcreate(H5P_DATASET_CREATE), doing);
  if (!shape.empty() && count >= kSmall) {
    check(H5Pset_chunk(plist, int(shape.size()), shape.data()), doing);
    check(H5Pset_shuffle(plist), doing);
    check(H5Pset_deflate(plist, 1), doing);
  }
  const Handle set(H5Dcreate2(parent, name.c_str(), type, space, H5P_DEFAULT, plist, H5P_DEFAULT), doing);
  if (count > 0) check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), doing);
  put_meaning(set, meaning);
}

std::vector<double> numbers(hid_t parent, const std::string& name) {
  return read<double>(parent, name);
}
std::vector<std::int64_t> integers(hid_t parent, const std::string& name) {
  return read<std::int64_t>(parent, name);
}

std::vector<std::string> texts(hid_t parent, const std::string& name) {
  const std::string doing = reading(parent, name);
  require(parent, "dataset", name);
  const Handle set(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), doing);
  const Handle space(H5Dget_space(set), doing);
  const Handle type = text_type();
  std::vector<char*> raw(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)), nullptr);
  if (raw.empty()) return {};
  check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()), doing);
  std::vector<std::string> out;
  for (const char* text : raw) out.emplace_back(text ? text : "");
  check(H5Dvlen_reclaim(type, space, H5P_DEFAULT, raw.data()), doing);
  return out;
}

Shape shape_of(hid_t parent, const std::string& name) {
  const std::string doing = reading(parent, name);
  const Handle set(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), doing);
  const Handle space(H5Dget_space(set), doing);
  Shape shape(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, shape.data(), nullptr);
  return shape;
}

Series::Series(hid_t parent, const std::string& name, const Meaning& meaning)
    : set_(open_or_create_series(parent, name, H5T_NATIVE_DOUBLE, meaning, rows_)) {}

void Series::write() {
  append(set_, H5T_NATIVE_DOUBLE, waiting_.data(), waiting_.size(), rows_);
  waiting_.clear();
}

TextSeries::TextSeries(hid_t parent, const std::string& name, const Meaning& meaning)
    : set_(open_or_create_series(parent, name, text_type(), meaning, rows_)) {}

void TextSeries::write() {
  std::vector<const char*> raw;
  for (const std::string& text : waiting_) raw.push_back(text.c_str());
  append(set_, text_type(), raw.data(), raw.size(), rows_);
  waiting_.clear();
}

}  // namespace couloir::h5
