#include "results/hdf5.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"

namespace grainstep::results::h5 {
namespace {

// The innermost message of the library's error stack.
herr_t innermost(unsigned depth, const H5E_error2_t* error, void* text) {
  if (depth == 0 && error->desc != nullptr) {
    *static_cast<std::string*>(text) = error->desc;
  }
  return 0;
}

std::string library_message() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, innermost, &text);
  return text.empty() ? "no reason given" : text;
}

void silence_the_library() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

// No file locking: a reader looks at a running run whenever it likes, and must not be able to stop it. The format is
// that of library 1.8, which has no flag that a crashed writer could leave behind.
Handle access_properties() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  H5Pset_file_locking(access.get(), 0, 1);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  return access;
}

}  // namespace

Handle& Handle::operator=(Handle&& other) noexcept {
  if (this != &other) {
    static_cast<void>(close());
    id_ = std::exchange(other.id_, -1);
    closer_ = other.closer_;
  }
  return *this;
}

bool Handle::close() {
  const hid_t id = std::exchange(id_, -1);
  return id < 0 || closer_(id) >= 0;
}

File::File(Handle file, std::filesystem::path path)
    : path_(std::move(path)), file_(std::move(file)), links_(H5Pcreate(H5P_LINK_CREATE), H5Pclose) {
  if (file_.get() < 0) {
    fail("cannot open");
  }
  require(H5Pset_create_intermediate_group(links_.get(), 1), "link properties");
}

File File::create(const std::filesystem::path& path) {
  silence_the_library();
  const Handle access = access_properties();
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);
  return {Handle(H5Fcreate(path.c_str(), H5F_ACC_EXCL, creation.get(), access.get()), H5Fclose), path};
}

File File::open(const std::filesystem::path& path) {
  silence_the_library();
  const Handle access = access_properties();
  return {Handle(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.get()), H5Fclose), path};
}

File File::read(const std::filesystem::path& path) {
  silence_the_library();
  const Handle access = access_properties();
  return {Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose), path};
}

void File::fail(const std::string& what) const {
  throw OutputError(path_.string() + ": " + what + ": " + library_message());
}

Handle File::take(hid_t id, Handle::Closer closer, const std::string& what) const {
  if (id < 0) {
    fail(what);
  }
  return {id, closer};
}

void File::require(herr_t result, const std::string& what) const {
  if (result < 0) {
    fail(what);
  }
}

void File::close() {
  if (!file_.close()) {
    fail("close");
  }
}

bool File::has(const std::string& dataset) const {
  for (std::size_t end = dataset.find('/', 1);; end = dataset.find('/', end + 1)) {
    if (H5Lexists(file_.get(), dataset.substr(0, end).c_str(), H5P_DEFAULT) <= 0) {
      return false;
    }
    if (end == std::string::npos) {
      return true;
    }
  }
}

void File::text_attribute(hid_t object, const char* name, const std::string& text) const {
  const Handle type = take(H5Tcopy(H5T_C_S1), H5Tclose, name);
  require(H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1)), name);
  require(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), name);
  require(H5Tset_cset(type.get(), H5T_CSET_UTF8), name);
  const Handle space = take(H5Screate(H5S_SCALAR), H5Sclose, name);
  const Handle attribute =
      take(H5Acreate2(object, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  const std::string padded = text.empty() ? std::string(1, '\0') : text;
  require(H5Awrite(attribute.get(), type.get(), padded.data()), name);
}

void File::label(hid_t object, const Meaning& meaning) const {
  text_attribute(object, "unit", meaning.unit);
  text_attribute(object, "title", meaning.title);
}

Handle File::make_extendable(const std::string& dataset, std::size_t columns, Kind kind, const Meaning& meaning) const {
  constexpr hsize_t chunk_values = 8192;  // 64 KiB: one or few chunks for a time series, little slack for short ones
  const std::array<hsize_t, 2> none = {0, columns};
  const std::array<hsize_t, 2> most = {H5S_UNLIMITED, columns};
  const std::array<hsize_t, 2> chunk = {columns == 0 ? chunk_values / 8 : std::max<hsize_t>(1, chunk_values / columns),
                                        columns};
  const int rank = columns == 0 ? 1 : 2;
  const Handle space = take(H5Screate_simple(rank, none.data(), most.data()), H5Sclose, dataset);
  const Handle creation = take(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, dataset);
  require(H5Pset_chunk(creation.get(), rank, chunk.data()), dataset);
  if (kind.packing == Packing::packed) {
    require(H5Pset_shuffle(creation.get()), dataset);  // bytes of equal weight together: what hardly changes is equal
    require(H5Pset_deflate(creation.get(), 1), dataset);
    require(H5Pset_fletcher32(creation.get()), dataset);
  }
  require(H5Pset_obj_track_times(creation.get(), false), dataset);
  Handle out =
      take(H5Dcreate2(file_.get(), dataset.c_str(), kind.type, space.get(), links_.get(), creation.get(), H5P_DEFAULT),
           H5Dclose, dataset);
  label(out.get(), meaning);
  return out;
}

void File::append_rows(const std::string& dataset, const void* values, std::size_t count, std::size_t columns,
                       Kind kind, const Meaning& meaning) {
  if (count == 0) {
    return;
  }
  const int rank = columns == 0 ? 1 : 2;
  const Handle target = has(dataset) ? take(H5Dopen2(file_.get(), dataset.c_str(), H5P_DEFAULT), H5Dclose, dataset)
                                     : make_extendable(dataset, columns, kind, meaning);
  std::array<hsize_t, 2> shape{};
  {
    const Handle space = take(H5Dget_space(target.get()), H5Sclose, dataset);
    require(H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr), dataset);
  }
  const std::array<hsize_t, 2> start = {shape[0], 0};
  const std::array<hsize_t, 2> block = {columns == 0 ? count : count / columns, columns};
  shape[0] += block[0];
  require(H5Dset_extent(target.get(), shape.data()), dataset);
  const Handle space = take(H5Dget_space(target.get()), H5Sclose, dataset);
  require(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), dataset);
  const Handle memory = take(H5Screate_simple(rank, block.data(), nullptr), H5Sclose, dataset);
  require(H5Dwrite(target.get(), kind.type, memory.get(), space.get(), H5P_DEFAULT, values), dataset);
}

void File::append(const std::string& dataset, std::span<const double> values, std::size_t columns,
                  const Meaning& meaning, Packing packing) {
  append_rows(dataset, values.data(), values.size(), columns, {H5T_IEEE_F64LE, packing}, meaning);
}

void File::append(const std::string& dataset, std::span<const std::uint64_t> values, const Meaning& meaning) {
  append_rows(dataset, values.data(), values.size(), 0, {H5T_STD_U64LE}, meaning);
}

void File::write_array(const std::string& dataset, const void* values, std::size_t count, std::size_t columns,
                       hid_t type, const Meaning& meaning) {
  const std::array<hsize_t, 2> shape = {columns == 0 ? count : count / columns, columns};
  const Handle space = take(H5Screate_simple(columns == 0 ? 1 : 2, shape.data(), nullptr), H5Sclose, dataset);
  const Handle creation = take(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, dataset);
  require(H5Pset_obj_track_times(creation.get(), false), dataset);
  const Handle target =
      take(H5Dcreate2(file_.get(), dataset.c_str(), type, space.get(), links_.get(), creation.get(), H5P_DEFAULT),
           H5Dclose, dataset);
  if (count > 0) {
    require(H5Dwrite(target.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), dataset);
  }
  label(target.get(), meaning);
}

void File::write(const std::string& dataset, std::span<const double> values, std::size_t columns,
                 const Meaning& meaning) {
  write_array(dataset, values.data(), values.size(), columns, H5T_IEEE_F64LE, meaning);
}

void File::write(const std::string& dataset, std::span<const std::uint32_t> values, std::size_t columns,
                 const Meaning& meaning) {
  write_array(dataset, values.data(), values.size(), columns, H5T_STD_U32LE, meaning);
}

void File::shrink(const std::string& dataset, std::uint64_t rows) {
  const Handle target = take(H5Dopen2(file_.get(), dataset.c_str(), H5P_DEFAULT), H5Dclose, dataset);
  std::array<hsize_t, 2> shape{};
  {
    const Handle space = take(H5Dget_space(target.get()), H5Sclose, dataset);
    require(H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr), dataset);
  }
  if (shape[0] < rows) {
    fail(dataset + " has " + std::to_string(shape[0]) + " rows, expected " + std::to_string(rows) + " or more");
  }
  shape[0] = rows;
  require(H5Dset_extent(target.get(), shape.data()), dataset);
}

void File::remove(const std::string& dataset) {
  require(H5Ldelete(file_.get(), dataset.c_str(), H5P_DEFAULT), dataset);
  for (std::string group = dataset.substr(0, dataset.rfind('/')); !group.empty();
       group = group.substr(0, group.rfind('/'))) {
    H5G_info_t info{};
    require(H5Gget_info_by_name(file_.get(), group.c_str(), &info, H5P_DEFAULT), group);
    if (info.nlinks > 0) return;
    require(H5Ldelete(file_.get(), group.c_str(), H5P_DEFAULT), group);
  }
}

std::vector<std::string> File::datasets() const {
  std::vector<std::string> found;
  const auto visit = [](hid_t, const char* name, const H5O_info_t* info, void* into) -> herr_t {
    if (info->type == H5O_TYPE_DATASET)
      static_cast<std::vector<std::string>*>(into)->push_back(std::string("/") + name);
    return 0;
  };
  require(H5Ovisit2(file_.get(), H5_INDEX_NAME, H5_ITER_INC, visit, &found, H5O_INFO_BASIC), "its datasets");
  return found;
}

void File::write(const std::string& dataset, const std::string& text, const std::string& title) {
  const Handle type = take(H5Tcopy(H5T_C_S1), H5Tclose, dataset);
  require(H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1)), dataset);
  require(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), dataset);
  require(H5Tset_cset(type.get(), H5T_CSET_UTF8), dataset);
  const Handle space = take(H5Screate(H5S_SCALAR), H5Sclose, dataset);
  const Handle creation = take(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, dataset);
  require(H5Pset_obj_track_times(creation.get(), false), dataset);
  const Handle target =
      take(H5Dcreate2(file_.get(), dataset.c_str(), type.get(), space.get(), links_.get(), creation.get(), H5P_DEFAULT),
           H5Dclose, dataset);
  const std::string padded = text.empty() ? std::string(1, '\0') : text;
  require(H5Dwrite(target.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()), dataset);
  label(target.get(), {.unit = "", .title = title});
}

void File::attribute(const std::string& object, const std::string& name, double value) {
  const Handle space = take(H5Screate(H5S_SCALAR), H5Sclose, name);
  const Handle target = take(H5Oopen(file_.get(), object.c_str(), H5P_DEFAULT), H5Oclose, object);
  const Handle attribute = take(
      H5Acreate2(target.get(), name.c_str(), H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  require(H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, &value), name);
}

std::vector<double> File::read_doubles(const std::string& dataset) const {
  const Handle source = take(H5Dopen2(file_.get(), dataset.c_str(), H5P_DEFAULT), H5Dclose, dataset);
  const Handle space = take(H5Dget_space(source.get()), H5Sclose, dataset);
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  std::vector<double> out(static_cast<std::size_t>(std::max<hssize_t>(count, 0)));
  if (!out.empty()) {
    require(H5Dread(source.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()), dataset);
  }
  return out;
}

File::Shape File::shape(const std::string& dataset) const {
  const Handle source = take(H5Dopen2(file_.get(), dataset.c_str(), H5P_DEFAULT), H5Dclose, dataset);
  const Handle space = take(H5Dget_space(source.get()), H5Sclose, dataset);
  std::array<hsize_t, 2> extent{};
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 1 || rank > 2) fail(dataset + " has " + std::to_string(rank) + " dimensions, expected 1 or 2");
  require(H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr), dataset);
  return {.rows = extent[0], .columns = rank == 2 ? extent[1] : 0};
}

void File::read_rows(const std::string& dataset, std::uint64_t first, std::uint64_t rows, std::span<double> out) const {
  const Handle source = take(H5Dopen2(file_.get(), dataset.c_str(), H5P_DEFAULT), H5Dclose, dataset);
  const Shape whole = shape(dataset);
  const std::array<hsize_t, 2> start = {first, 0};
  const std::array<hsize_t, 2> block = {rows, whole.columns};
  if (first + rows > whole.rows || out.size() < rows * std::max<std::uint64_t>(whole.columns, 1))
    fail(dataset + ": rows that are not there were asked for");
  const Handle space = take(H5Dget_space(source.get()), H5Sclose, dataset);
  require(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, block.data(), nullptr), dataset);
  const Handle memory = take(H5Screate_simple(whole.columns == 0 ? 1 : 2, block.data(), nullptr), H5Sclose, dataset);
  require(H5Dread(source.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, out.data()), dataset);
}

std::string File::read_text(const std::string& dataset) const {
  const Handle source = take(H5Dopen2(file_.get(), dataset.c_str(), H5P_DEFAULT), H5Dclose, dataset);
  const Handle type = take(H5Dget_type(source.get()), H5Tclose, dataset);
  std::string out(H5Tget_size(type.get()), '\0');
  require(H5Dread(source.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()), dataset);
  out.resize(std::min(out.size(), out.find('\0')));
  return out;
}

}  // namespace grainstep::results::h5
