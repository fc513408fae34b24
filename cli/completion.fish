# Completion of wormdrive in fish: commands, options, their choices and files. The program is asked, as in
# completion.bash. Installed to share/fish/vendor_completions.d/wormdrive.fish.

function __wormdrive_complete
    set -l typed (commandline -opc)
    set -l current (commandline -ct)
    set -l program $typed[1]
    if test (count $typed) -eq 1
        $program --help 2>/dev/null | sed -n 's/^  \([a-z][a-z]*\)  *\(.*\)/\1\t\2/p'
        return
    end
    set -l help ($program $typed[2] --help 2>/dev/null)
    or return
    if string match -q -- '-*' $current
        printf '%s\n' $help | sed -n '/^Options:/,$ s/^  \(-[a-zA-Z],\)\{0,1\}\(--[a-z-]*\).*/\2/p'
        return
    end
    set -l choices
    if string match -q -- '-*' $typed[-1]
        set choices (printf '%s\n' $help | sed -n "s/^  \(-[a-zA-Z],\)\{0,1\}$typed[-1] [^ ]*{\([^}]*\)}.*/\2/p")
    else
        set choices (printf '%s\n' $help | sed -n '/^Arguments:/,/^Options:/ s/^  [a-z]* [^ ]*{\([^}]*\)}.*/\1/p')
    end
    if test -n "$choices"
        string split , $choices
    else
        __fish_complete_suffix .toml .h5 .hdf5 .part .csv .mat .fmu
    end
end

complete -c wormdrive -f -a '(__wormdrive_complete)'
