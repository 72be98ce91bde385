# Completion of cases, options and keys for bash: `. cases/completion.bash', or installed by make install.
# SPDX-License-Identifier: BSD-3-Clause
_estran() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} here cases
    here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
    for cases in "$here" "$here/../../estran/cases" /usr/share/estran/cases; do [ -f "$cases/parameters.md" ] && break; done
    case $before in
    -p) COMPREPLY=($(compgen -S = -W "$(sed -n 's/^| `\([a-z_]*\.[A-Za-z0-9_]*\)`.*/\1/p; s/^| \([a-z_]*\.[A-Za-z0-9_]*\) .*/\1/p' "$cases/parameters.md")" -- "$word")); return ;;
    esac
    case $word in
    -*) COMPREPLY=($(compgen -W "-n -o -p --check --check=picture --restart --force --tune --help --movie --curves --compare --report --vtkhdf" -- "$word")) ;;
    *) COMPREPLY=($(compgen -W "$(cd "$cases" && printf '%s\n' */case.cfg | sed 's,/.*,,')" -- "$word") $(compgen -f -- "$word")) ;;
    esac
}
complete -F _estran estran-run estran-plot estran-sweep estran-ensemble estran-sph estran-fv cases/run cases/plot cases/sweep cases/ensemble
