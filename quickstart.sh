#!/usr/bin/env bash
# From a fresh checkout to the first pictures: installs packages, builds, runs two examples, writes to out/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

tools/install_packages.sh
cmake --preset release
cmake --build --preset release --target wormdrive wormdrive_python

wormdrive=build/release/wormdrive
mkdir -p out
"$wormdrive" run scenarios/fig09_switching.toml --audit -o out/fig09_switching.h5
"$wormdrive" run scenarios/measured_worm_drive.toml -o out/measured_worm_drive.h5
for name in fig09_switching measured_worm_drive; do
  "$wormdrive" plot "out/$name.h5" -o "out/$name.png"
done

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
