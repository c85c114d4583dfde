# Installs what is missing of tools/packages.txt; sourced by ./run and ./test from the repository's root.
# Asks dpkg once (some 20 ms), so that a second call installs nothing and costs nothing.

setup() {
    local wanted missing sudo=
    wanted=$(sed -e 's/#.*//' tools/packages.txt | awk 'NF { print $1 }')
    missing=$(for package in $wanted; do echo "$package"; done |
        grep -vxF -f <(dpkg-query -W -f '${binary:Package} ${db:Status-Status}\n' 2>/dev/null |
            awk '$2 == "installed" { sub(/:.*/, "", $1); print $1 }'))
    [ -z "$missing" ] && return 0
    if ! command -v apt-get >/dev/null; then
        echo "These Debian packages, or what your system calls them, are needed:" $missing >&2
        return 1
    fi
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null || { echo "Run this as root, or install sudo: these packages are missing:" $missing >&2; return 1; }
        sudo=sudo
    fi
    echo "Installing:" $missing >&2
    $sudo apt-get update -q >&2 &&
        $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing >&2
}

# build PRESET [TARGET]: configures once, then builds what changed. The first time it tells how far it is; later, only
# what went wrong.
build() {
    [ -f "build/$1/build.ninja" ] || cmake --preset "$1" >&2 || return 1
    if [ -f "build/$1/built" ]; then
        ninja -C "build/$1" --quiet ${2:+"$2"} 2>&1 | grep -vE '^ninja: (no work|Entering)' >&2
        return "${PIPESTATUS[0]}"
    fi
    cmake --build --preset "$1" ${2:+--target "$2"} >&2 && touch "build/$1/built"
}
