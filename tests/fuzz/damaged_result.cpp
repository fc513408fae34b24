#include "fuzz/damaged_result.hpp"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include "fuzz/targets.hpp"
#include "output/check_result.hpp"
#include "simulation/load_scenario.hpp"
#include "sweep/file/sweep_file.hpp"
#include "sweep/summary/summary.hpp"

namespace wormdrive::fuzz {
namespace {

namespace fs = std::filesystem;

/// A file that is being written, in memory: so this process reads what is damaged itself, where a child of it would be
/// the one that falls, at a hundredth of the rate.
void write_results() {
  static const Hdf5Handle held = [] {
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "no properties");
    H5Pset_fapl_core(access, 4096, false);
    return Hdf5Handle(H5Fcreate("held", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose, "no file in memory");
  }();
}

void make(const std::string& words) {
  if (std::system((std::string(WORMDRIVE_PROGRAM) + " " + words).c_str()) != 0)
    throw std::runtime_error("no seed: wormdrive " + words);
}

/// What an order works on: the columns of all tables, and the attributes of the file itself.
struct Objects {
  std::vector<std::string> columns, attributes;
};

/// A result as wormdrive wrote it.
struct Good {
  std::string path;
  Objects objects;
};
std::vector<Good> good_results, good_sweeps;

/// A number below an end that follows from all bytes of an input (FNV-1a).
std::size_t drawn(const std::uint8_t* data, std::size_t size, std::size_t end) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (std::size_t k = 0; k < size; ++k) hash = (hash ^ data[k]) * 0x100000001b3;
  return (hash >> 32) % end;
}

Objects objects_of(const std::string& path) {
  const Hdf5Handle file = open_hdf5(path);
  Objects all{{}, {"kind", "title", "scenario", "study", "build", "first_trial", "end_trial"}};
  for (const std::string& table : members_of(file, "/")) {
    const Hdf5Handle group = open_object(file, table);
    if (H5Iget_type(group) != H5I_GROUP) continue;
    for (const std::string& name : members_of(file, table)) all.columns.push_back(table + "/" + name);
  }
  return all;
}

struct Order {
  std::uint8_t object, action, type, row;
  std::int64_t number;
};

hid_t type_of(std::uint8_t which) {
  const hid_t types[] = {H5T_IEEE_F64LE, H5T_STD_I8LE, H5T_IEEE_F32LE, H5T_STD_I64LE, H5T_STD_U16BE, H5T_C_S1};
  return types[which % std::size(types)];
}

void replace_column(hid_t file, const std::string& path, const Order& order, bool chunked) {
  hsize_t rows = chunked ? static_cast<hsize_t>(order.number) & 0xffffffffffULL : order.row;
  if (rows == 0) rows = 1;
  const hsize_t chunk = std::min<hsize_t>(rows, 4096), two[] = {rows, 2};
  const hid_t space = order.type & 64 ? H5Screate_simple(2, two, nullptr) : H5Screate_simple(1, &rows, nullptr);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t chunks[] = {chunk, 2};
  if (chunked) H5Pset_chunk(properties, order.type & 64 ? 2 : 1, chunks);
  H5Ldelete(file, path.c_str(), H5P_DEFAULT);
  const hid_t column = H5Dcreate2(file, path.c_str(), type_of(order.type), space, H5P_DEFAULT, properties, H5P_DEFAULT);
  const std::vector<double> values(chunked ? 0 : 2 * rows, static_cast<double>(order.number));
  if (!chunked && column >= 0 && order.type % 6 != 5)
    H5Dwrite(column, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  if (column >= 0) H5Dclose(column);
  H5Pclose(properties);
  H5Sclose(space);
}

void overwrite(hid_t file, const std::string& path, const Order& order) {
  const hid_t column = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
  if (column < 0) return;
  const hid_t space = H5Dget_space(column);
  const hssize_t rows = H5Sget_simple_extent_npoints(space);
  if (rows > 0 && H5Sget_simple_extent_ndims(space) == 1) {
    const hsize_t row = static_cast<hsize_t>(order.row) % static_cast<hsize_t>(rows), one = 1;
    double value = 0.0;
    std::memcpy(&value, &order.number, sizeof value);
    if (order.type & 1) value = static_cast<double>(order.number % 300);
    const hid_t memory = H5Screate_simple(1, &one, nullptr);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, &row, nullptr, &one, nullptr);
    H5Dwrite(column, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, &value);
    H5Sclose(memory);
  }
  H5Sclose(space);
  H5Dclose(column);
}

void replace_attribute(hid_t file, const std::string& name, const Order& order) {
  H5Adelete(file, name.c_str());
  const hsize_t size = 1 + order.row;
  const hid_t space = order.type & 64 ? H5Screate_simple(1, &size, nullptr) : H5Screate(H5S_SCALAR);
  const hid_t attribute = H5Acreate2(file, name.c_str(), type_of(order.type), space, H5P_DEFAULT, H5P_DEFAULT);
  const std::vector<std::int64_t> values(size, order.number);
  if (attribute >= 0) {
    if (order.type % 6 != 5) H5Awrite(attribute, H5T_NATIVE_INT64, values.data());
    H5Aclose(attribute);
  }
  H5Sclose(space);
}

void obey(hid_t file, const Objects& objects, const Order& order) {
  const std::string& column = objects.columns[order.object % objects.columns.size()];
  const std::string& attribute = objects.attributes[order.object % objects.attributes.size()];
  switch (order.action % 10) {
    case 0: H5Ldelete(file, column.c_str(), H5P_DEFAULT); break;
    case 1: replace_column(file, column, order, false); break;
    case 2: replace_column(file, column, order, true); break;
    case 3: replace_attribute(file, attribute, order); break;
    case 4: H5Adelete(file, attribute.c_str()); break;
    case 5:
      H5Ldelete(file, column.c_str(), H5P_DEFAULT);
      H5Lcreate_soft(("/" + objects.columns[order.row % objects.columns.size()]).c_str(), file, column.c_str(),
                     H5P_DEFAULT, H5P_DEFAULT);
      break;
    case 6:
      H5Ldelete(file, column.c_str(), H5P_DEFAULT);
      H5Lcreate_external("/dev/zero", "x", file, column.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    case 7:
      H5Ldelete(file, column.c_str(), H5P_DEFAULT);
      H5Lcreate_hard(file, "/", file, column.c_str(), H5P_DEFAULT, H5P_DEFAULT);
      break;
    default: overwrite(file, column, order); break;
  }
}

/// The path of a copy of one of the good files that was damaged by orders of 12 bytes each.
std::string damaged(const std::vector<Good>& all, const std::uint8_t* data, std::size_t size) {
  const Good& good = all[drawn(data, size, all.size())];
  const std::string path = good.path + ".damaged";
  fs::copy_file(good.path, path, fs::copy_options::overwrite_existing);
  const Hdf5Handle file = reopen_hdf5(path);
  for (std::size_t at = 0; at + 12 <= std::min<std::size_t>(size, 120); at += 12) {
    Order order{data[at], data[at + 1], data[at + 2], data[at + 3], 0};
    std::memcpy(&order.number, data + at + 4, sizeof order.number);
    obey(file, good.objects, order);
  }
  return path;
}

std::vector<std::vector<std::uint8_t>> orders() {
  std::vector<std::vector<std::uint8_t>> all{{}};
  for (std::uint8_t action = 0; action < 10; ++action)
    all.push_back({static_cast<std::uint8_t>(7 * action), action, 1, 1, 100, 0, 0, 0, 0, 0, 0, 0});
  return all;
}

const std::string scenario = " " WORMDRIVE_SCENARIOS "/fig09_switching.toml";

std::string study_in(const fs::path& folder) {
  const std::string path = (folder / "study.toml").string();
  std::ofstream(path) << "scenario = \"" WORMDRIVE_SCENARIOS
                         "/fig09_switching.toml\"\n"
                         "set = [\"run.solver=taylor\", \"run.duration_s=0.1\"]\n"
                         "metrics = [\"final_gear_angle\", \"final_gear_speed\", \"stop_events\"]\n"
                         "[sweep]\ndesign = \"monte_carlo\"\ntrials = 12\nseed = 1\n"
                         "[[parameter]]\npath = \"mesh.friction\"\ndistribution = \"uniform\"\n"
                         "low = 0.2\nhigh = 0.3\n"
                         "[[threshold]]\nmetric = \"final_gear_angle\"\nabove_rad = -0.0416\n";
  return " " + path;
}

void add(std::vector<Good>& all, const fs::path& folder, const std::string& words) {
  const std::string path = (folder / (std::to_string(all.size()) + ".h5")).string();
  make(words + " --force -o " + path);
  all.push_back({path, objects_of(path)});
}

}  // namespace

std::vector<std::vector<std::uint8_t>> result_file_seeds(const fs::path& folder) {
  write_results();
  add(good_results, folder, "run -q --set run.report_interval_s=0.02" + scenario);
  add(good_results, folder, "statics -q --points 5" + scenario);
  add(good_results, folder, "steady -q --points 5" + scenario);
  add(good_results, folder, "efficiency -q --points 3" + scenario);
  add(good_results, folder, "rare --per-level 100 --samples 100" + study_in(folder) + " >/dev/null");
  return orders();
}

void take_damaged_result(const std::uint8_t* data, std::size_t size) {
  const std::string path = damaged(good_results, data, size);
  refusable([&] { load_scenario(path, {}, Purpose::look); });
  refusable([&] {
    const Hdf5Handle file = open_hdf5(path);
    check_result(file);
    // one of its tables: most of the time goes into the opening of columns
    const std::vector<std::string> tables = members_of(file, "/");
    const StoredTable stored(file, tables[drawn(data, size, tables.size())]);
    for (const std::string& name : stored.numbers())
      if (stored.column(name).values().size() != stored.rows())
        throw std::logic_error("columns of a table that was found good differ in length");
  });
}

std::vector<std::vector<std::uint8_t>> sweep_file_seeds(const fs::path& folder) {
  write_results();
  add(good_sweeps, folder, "sweep -q" + study_in(folder));
  add(good_sweeps, folder, "sweep -q --shard 2/3" + study_in(folder));
  return orders();
}

void take_damaged_sweep(const std::uint8_t* data, std::size_t size) {
  const std::string path = damaged(good_sweeps, data, size);
  refusable([&] {
    const SweepReader sweep(path);
    for (const TrialRange& range : sweep.present()) for_each_trial(sweep, range, [](const Trial&) {});
    sweep.verdicts();
    sweep.counted_reasons();
    summarise(sweep, {.worst = 5});
  });
}

}  // namespace wormdrive::fuzz
