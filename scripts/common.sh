# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# What scripts/metals and scripts/test share: packages if missing, then a release build. Safe to repeat.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages_file=scripts/packages.txt

say() { printf 'iride: %s\n' "$*" >&2; }

packages() { sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$packages_file"; }

missing_packages() {
    local package
    while read -r package _; do
        [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || printf '%s\n' "$package"
    done < <(packages)
}

needed_elsewhere() {
    say "this system has no dpkg and apt-get (it is not Debian or Ubuntu). Iride needs these libraries and tools, in"
    say "these versions (Embree 3, not 4; Catch2 2, not 3; newer minor versions otherwise):"
    packages | while read -r _ library version; do printf '    %-18s %s\n' "$library" "$version" >&2; done
    say "when they are installed: cmake --preset release && cmake --build --preset release"
    exit 2
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        env DEBIAN_FRONTEND=noninteractive "$@"
    else
        sudo env DEBIAN_FRONTEND=noninteractive "$@"
    fi
}

install_packages() {
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then needed_elsewhere; fi
    local missing
    mapfile -t missing < <(missing_packages)
    [ "${#missing[@]}" -gt 0 ] || return 0
    local -a install=(apt-get install -y --no-install-recommends "${missing[@]}")
    say "missing packages: ${missing[*]}"
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            say "not root, and no sudo; as root: ${install[*]}"
            exit 2
        fi
        say "not root: apt-get runs under sudo, which may ask for your password"
    fi
    # A fresh system has no package lists, an old one stale ones.
    if ! apt-cache show "${missing[@]}" >/dev/null 2>&1; then as_root apt-get update; fi
    as_root "${install[@]}" || { as_root apt-get update && as_root "${install[@]}"; }
}

# build_release TARGET...: configure and build the release preset.
build_release() {
    cmake --preset release
    cmake --build --preset release --parallel "$(nproc)" --target "$@"
}

# build_lanes N: `iride` with N wavelengths per path, in build/lanes-N.
build_lanes() {
    cmake --preset release -B "build/lanes-$1" -D IRIDE_LANES="$1"
    cmake --build "build/lanes-$1" --parallel "$(nproc)" --target iride
}
