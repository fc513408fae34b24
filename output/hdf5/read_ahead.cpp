#include "output/hdf5/read_ahead.hpp"

#include "output/check_result.hpp"
#include "output/hdf5/stored_table.hpp"
#include "output/in_a_copy.hpp"

namespace wormdrive {
namespace {

bool writes_results() {
  std::vector<hid_t> files(16);
  const ssize_t count = H5Fget_obj_ids(H5F_OBJ_ALL, H5F_OBJ_FILE, files.size(), files.data());
  for (ssize_t k = 0; k < count; ++k) {
    unsigned intent = 0;
    if (H5Fget_intent(files[static_cast<std::size_t>(k)], &intent) < 0 || (intent & H5F_ACC_RDWR) != 0) return true;
  }
  return false;
}

/// Does what may be refused: whoever reads the file in earnest tells it.
template <class Read>
void attempt(Read&& read) {
  try {
    read();
  } catch (const OutputFault&) {
  }
}

void read_attributes(hid_t object) {
  const auto read = [](hid_t of, const char* name, const H5A_info_t*, void*) {
    attempt([&] { read_text_attribute(of, name); });
    return herr_t{0};
  };
  H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, read, nullptr);
}

void read_column_ends(hid_t file, const std::string& path) {
  const StoredColumn column(file, path);
  switch (column.type()) {
    case StoredColumn::Type::number:
    case StoredColumn::Type::flag:
      if (column.rows() == 0) break;
      column.values(0, 1);
      column.values(column.rows() - 1, 1);
      break;
    case StoredColumn::Type::text:
    case StoredColumn::Type::padded_text: column.texts(); break;
  }
}

/// Columns of columns do not exist: two levels are all that a result has.
void read_all(const std::string& path, bool while_written) {
  const Hdf5Handle file = while_written ? open_hdf5_while_written(path) : open_hdf5(path);
  for (const char* const name : {"kind", "wormdrive_version", "title", "scenario", "study", "build"})
    attempt([&] { read_text_attribute(file, name); });  // also where a list of them cannot be had
  attempt([&] { check_result(file); });
  read_attributes(file);
  for (const std::string& table : members_of(file, "/"))
    attempt([&] {
      read_attributes(open_object(file, table));
      for (const std::string& name : members_of(file, table))
        attempt([&] {
          read_attributes(open_object(file, table + "/" + name));
          read_column_ends(file, table + "/" + name);
        });
    });
}

}  // namespace

void read_ahead(const std::string& path, bool while_written) {
  if (!is_hdf5(path) || writes_results()) return;
  const bool ends = ends_well_in_a_copy([&] { read_all(path, while_written); });
  if (!ends) throw ReadFault(path, "it is damaged: reading its structure and texts does not come to an end");
}

}  // namespace wormdrive
