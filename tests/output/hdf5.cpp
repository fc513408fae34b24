#include "output/hdf5/hdf5.hpp"

#include <cerrno>

#include "catch.hpp"
#include "cli/program.hpp"
#include "output/hdf5/part_file.hpp"

namespace wormdrive::test::output_hdf5 {

TEST_CASE("a file that cannot be opened is reported with the system's reason, or without one if HDF5 rejects it") {
  const Folder folder;
  folder.write("text.h5", "no HDF5\n");
  folder.write("errno = 13", "no HDF5\n");
  std::filesystem::create_directory(folder.path() / "folder");
  const auto told = [&](const std::string& name) -> std::string {
    errno = EACCES;  // of something before
    try {
      open_hdf5(folder / name);
      return "";
    } catch (const ReadFault& fault) {
      return fault.what();
    }
  };
  CHECK(told("text.h5") == "it cannot be opened as HDF5");
  CHECK(told("errno = 13") == "it cannot be opened as HDF5");
  CHECK(told("none.h5") == "it cannot be opened as HDF5: No such file or directory");
  CHECK(told("errno = 1") == "it cannot be opened as HDF5: No such file or directory");
  CHECK(told("folder") == "it cannot be opened as HDF5: Is a directory");
  CHECK_THROWS_WITH(create_hdf5(folder / "nowhere/a.h5"),
                    "cannot create " + (folder / "nowhere/a.h5") + ": No such file or directory");
}

TEST_CASE("what a handle that closes itself cannot write is told before a file gets its name") {
  const Folder folder;
  const std::string path = folder / "a.h5";
  PartFile part(path, "run");
  {
    const Hdf5Handle full(
        create_group(part.file(), "group"), [](hid_t) -> herr_t { return -1; }, "no group");
  }
  CHECK_THROWS_WITH(part.finish(), "cannot write " + path + ".part");
  CHECK_FALSE(std::filesystem::exists(path));
  part.finish();  // it is told once
  CHECK(std::filesystem::exists(path));
}

}  // namespace wormdrive::test::output_hdf5
