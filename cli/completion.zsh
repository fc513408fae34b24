#compdef wormdrive
# Completion of wormdrive in zsh: commands, options, their choices and files. The program is asked, as in
# completion.bash. Installed to share/zsh/vendor-completions/_wormdrive.

_wormdrive() {
  local program=$words[1] previous=$words[CURRENT-1] help choices
  local -a found
  if ((CURRENT == 2)); then
    found=(${(f)"$($program --help 2>/dev/null | sed -n 's/^  \([a-z][a-z]*\)  *\(.*\)/\1:\2/p')"})
    _describe command found
    return
  fi
  help=$($program $words[2] --help 2>/dev/null) || return 0
  if [[ $words[CURRENT] == -* ]]; then
    found=(${(f)"$(sed -n '/^Options:/,$ s/^  \(-[a-zA-Z],\)\{0,1\}\(--[a-z-]*\).*/\2/p' <<<$help)"})
    compadd -- $found
    return
  fi
  if [[ $previous == -* ]]; then
    choices=$(sed -n "s/^  \(-[a-zA-Z],\)\{0,1\}$previous [^ ]*{\([^}]*\)}.*/\2/p" <<<$help)
  else
    choices=$(sed -n '/^Arguments:/,/^Options:/ s/^  [a-z]* [^ ]*{\([^}]*\)}.*/\1/p' <<<$help)
  fi
  if [[ -n $choices ]]; then
    compadd -- ${(s:,:)choices}
  else
    _files -g '*.(toml|h5|hdf5|part|csv|mat|fmu)'
  fi
}

_wormdrive "$@"
