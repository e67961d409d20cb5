# Sourced by tests/run and examples/run: need_packages NAME... installs the Debian packages that are missing.
# As root or with a sudo that asks nothing; otherwise it prints the line to type and ends the script.
need_packages() {
    command -v apt-get >/dev/null || return 0 # not Debian: CMake names what it misses
    local missing=() name
    for name in "$@"; do
        [[ $(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null) == installed ]] || missing+=("$name")
    done
    ((${#missing[@]})) || return 0
    local root=()
    if ((EUID != 0)); then
        if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
            echo "These packages are missing; please type:" >&2
            echo "  sudo apt-get update && sudo apt-get install -y --no-install-recommends ${missing[*]}" >&2
            exit 1
        fi
        root=(sudo -n)
    fi
    echo "installing ${missing[*]}" >&2
    "${root[@]}" apt-get -q update >&2
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends "${missing[@]}" >&2
}

# The same for a part that can be left out: false, with the reason in $missing_packages, where they cannot be installed.
try_packages() {
    missing_packages=
    (need_packages "$@") && return 0
    missing_packages="cannot install $*"
    return 1
}
