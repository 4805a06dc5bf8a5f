#include "coupling/records/h5_driver.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "coupling/records/whole_io.hpp"

namespace couloir::h5 {
namespace {

struct Access {  // what the access list carries
  UndoJournal* journal;
};

struct File {
  H5FD_t base;  // HDF5's own part comes first
  int id;
  UndoJournal* journal;
  haddr_t allocated, end;
  struct stat place;
};

File& file_of(H5FD_t* base) {
  return *reinterpret_cast<File*>(base);
}
const File& file_of(const H5FD_t* base) {
  return *reinterpret_cast<const File*>(base);
}

// In the words of HDF5's own driver, in which h5.cpp finds the reason.
herr_t say(hid_t kind, const char* doing) {
  H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_VFL, kind, "%s, error message = '%s'", doing,
           std::strerror(errno));
  return -1;
}

H5FD_t* open_file(const char* name, unsigned flags, hid_t access, haddr_t) {
  int how = O_CLOEXEC | (flags & H5F_ACC_RDWR ? O_RDWR : O_RDONLY);
  if (flags & H5F_ACC_TRUNC) how |= O_TRUNC;
  if (flags & H5F_ACC_CREAT) how |= O_CREAT;
  if (flags & H5F_ACC_EXCL) how |= O_EXCL;
  const auto* info = static_cast<const Access*>(H5Pget_driver_info(access));
  auto file = std::make_unique<File>();
  std::memset(&file->base, 0, sizeof file->base);
  file->id = ::open(name, how, 0666);
  if (file->id < 0 || fstat(file->id, &file->place) != 0) {
    say(H5E_CANTOPENFILE, "unable to open the file");
    if (file->id >= 0) ::close(file->id);
    return nullptr;
  }
  file->journal = info ? info->journal : nullptr;
  file->allocated = 0;
  file->end = static_cast<haddr_t>(file->place.st_size);
  return &file.release()->base;
}

herr_t close_file(H5FD_t* base) {
  const std::unique_ptr<File> file(&file_of(base));
  return ::close(file->id) == 0 ? 0 : say(H5E_CANTCLOSEFILE, "unable to close the file");
}

int compare(const H5FD_t* a, const H5FD_t* b) {
  const struct stat &p = file_of(a).place, &q = file_of(b).place;
  if (p.st_dev != q.st_dev) return p.st_dev < q.st_dev ? -1 : 1;
  if (p.st_ino != q.st_ino) return p.st_ino < q.st_ino ? -1 : 1;
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* features) {
  if (features)
    *features =
        H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t get_allocated(const H5FD_t* base, H5FD_mem_t) {
  return file_of(base).allocated;
}
herr_t set_allocated(H5FD_t* base, H5FD_mem_t, haddr_t at) {
  file_of(base).allocated = at;
  return 0;
}
haddr_t get_end(const H5FD_t* base, H5FD_mem_t) {
  return file_of(base).end;
}
herr_t get_handle(H5FD_t* base, hid_t, void** handle) {
  *handle = &file_of(base).id;
  return 0;
}

herr_t read(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t at, std::size_t count, void* data) {
  const std::int64_t got = read_whole(file_of(base).id, data, count, at);
  if (got < 0) return say(H5E_READERROR, "file read failed");
  std::memset(static_cast<char*>(data) + got, 0, count - static_cast<std::size_t>(got));  // beyond the end
  return 0;
}

herr_t write(H5FD_t* base, H5FD_mem_t, hid_t, haddr_t at, std::size_t count, const void* data) {
  File& file = file_of(base);
  if (file.journal && !file.journal->note(file.id, at, count)) return say(H5E_WRITEERROR, "file write failed");
  if (!write_whole(file.id, data, count, at)) return say(H5E_WRITEERROR, "file write failed");
  file.end = std::max(file.end, at + count);
  return 0;
}

herr_t truncate(H5FD_t* base, hid_t, hbool_t) {
  File& file = file_of(base);
  if (file.allocated == file.end) return 0;
  if (file.allocated < file.end && file.journal && !file.journal->note(file.id, file.allocated, file.end - file.allocated))
    return say(H5E_WRITEERROR, "file write failed");
  if (ftruncate(file.id, static_cast<off_t>(file.allocated)) != 0) return say(H5E_SEEKERROR, "unable to extend the file");
  file.end = file.allocated;
  return 0;
}

hid_t driver() {
  static const hid_t id = [] {
    H5FD_class_t c{};
    c.name = "couloir";
    c.maxaddr = static_cast<haddr_t>(1) << 62;
    c.fc_degree = H5F_CLOSE_WEAK;
    c.fapl_size = sizeof(Access);
    c.open = open_file;
    c.close = close_file;
    c.cmp = compare;
    c.query = query;
    c.get_eoa = get_allocated;
    c.set_eoa = set_allocated;
    c.get_eof = get_end;
    c.get_handle = get_handle;
    c.read = read;
    c.write = write;
    c.truncate = truncate;
    const H5FD_mem_t plain[] = H5FD_FLMAP_DICHOTOMY;
    std::copy(std::begin(plain), std::end(plain), c.fl_map);
    return H5FDregister(&c);
  }();
  return id;
}

}  // namespace

herr_t use_journal(hid_t access, UndoJournal& journal) {
  const Access info{&journal};
  return H5Pset_driver(access, driver(), &info);
}

}  // namespace couloir::h5
