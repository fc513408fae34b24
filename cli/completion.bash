# Completion of wormdrive in bash: commands, options, their choices and files. The program is asked, so that nothing
# here has to follow it. Installed to share/bash-completion/completions/wormdrive; or: source cli/completion.bash

_wormdrive() {
  local program=${COMP_WORDS[0]} current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local help words
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    words=$("$program" --help 2>/dev/null | sed -n 's/^  \([a-z][a-z]*\)  .*/\1/p')
    mapfile -t COMPREPLY < <(compgen -W "$words --help --version" -- "$current")
    return
  fi
  help=$("$program" "${COMP_WORDS[1]}" --help 2>/dev/null) || return 0
  if [[ $current == -* ]]; then
    words=$(sed -n '/^Options:/,$ s/^  \(-[a-zA-Z],\)\{0,1\}\(--[a-z-]*\).*/\2/p' <<<"$help")
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    return
  fi
  if [[ $previous == -* ]]; then  # choices of an option: --over TEXT:{motor_torque}
    words=$(sed -n "s/^  \(-[a-zA-Z],\)\{0,1\}$previous [^ ]*{\([^}]*\)}.*/\2/p" <<<"$help")
  else  # of an argument
    words=$(sed -n '/^Arguments:/,/^Options:/ s/^  [a-z]* [^ ]*{\([^}]*\)}.*/\1/p' <<<"$help")
  fi
  if [[ -n $words ]]; then
    mapfile -t COMPREPLY < <(compgen -W "${words//,/ }" -- "$current")
    return
  fi
  mapfile -t COMPREPLY < <(compgen -f -X '!*.@(toml|h5|hdf5|part|csv|mat|fmu)' -- "$current"; compgen -d -- "$current")
}

# extglob for the pattern above, where the user has it off
shopt -q extglob || shopt -s extglob
complete -o filenames -F _wormdrive wormdrive
