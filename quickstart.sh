#!/usr/bin/env bash
# From a fresh checkout to the first pictures: installs packages, builds, runs two examples, writes to out/. The first
# picture is there before the rest of the program is built.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

tools/install_packages.sh
cmake --preset release
mkdir -p out

cmake --build --preset release --target first_run
build/release/first_run scenarios/fig09_switching.toml out/fig09_switching.h5
/usr/bin/python3 -B plots/plot.py --output=out/fig09_switching.png out/fig09_switching.h5
echo "  picture  $PWD/out/fig09_switching.png shows this run; now the rest of the program is built"

cmake --build --preset release --target wormdrive wormdrive_python
wormdrive=build/release/wormdrive
"$wormdrive" run scenarios/measured_worm_drive.toml -o out/measured_worm_drive.h5
"$wormdrive" plot out/measured_worm_drive.h5 -o out/measured_worm_drive.png

cat <<END

In $PWD/out:
$(find out -type f -printf '  %-32P %9s bytes\n' | sort)

What next, from $PWD:
  export PATH="\$PWD/build/release:\$PATH"    then \`wormdrive --help\` lists the commands
  export PYTHONPATH="\$PWD/build/release/python"    then Python imports wormdrive
  wormdrive report out/fig09_switching.h5    the first run as a page for the browser
  wormdrive new my_drive.toml    a drive of your own: edit it, then wormdrive run my_drive.toml
  ./run_tests.sh    check this build
END
