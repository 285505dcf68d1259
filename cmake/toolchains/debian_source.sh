#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The libcgt authors
# SPDX-License-Identifier: MIT
#
# debian_source.sh PACKAGE DIR
# Fetches what its authors published of a Debian source package, and unpacks it to DIR. It comes through a private apt
# configuration made from this machine's own Debian entries: the host's apt is left as it is. Nothing is done where DIR
# is there.
set -euo pipefail
package=${1:?"usage: debian_source.sh PACKAGE DIR"} to=${2:?"usage: debian_source.sh PACKAGE DIR"}
[ ! -d "$to" ] || exit 0
mkdir -p "$to.part/source"
part=$(cd "$to.part" && pwd)
apt=$part/apt

fail() {
    echo "debian_source: $1" >&2
    exit 1
}

# The host's entries for this release, turned into entries for source packages.
write_sources() {
    local codename
    codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
    [ -n "$codename" ] || fail "/etc/os-release names no release"
    find /etc/apt/sources.list /etc/apt/sources.list.d -name '*.sources' -exec cat {} + -exec echo \; 2>/dev/null |
        grep -v '^[[:space:]]*#' |
        awk -v name="$codename" 'BEGIN { RS = ""; ORS = "\n\n" } $0 ~ "Suites:[^\n]*[ \t]" name "([ \t\n]|$)" {
            sub(/Types:[^\n]*/, "Types: deb-src"); print }' >"$apt/sources.list.d/host.sources" || true
    find /etc/apt/sources.list /etc/apt/sources.list.d \( -name '*.list' \) -exec cat {} + 2>/dev/null |
        sed -nE "s/^deb((-src)?[[:space:]].*[[:space:]]$codename[[:space:]])/deb-src\1/p" |
        sed 's/^deb-src-src/deb-src/' | sort -u >"$apt/sources.list" || true
    [ -s "$apt/sources.list" ] || [ -s "$apt/sources.list.d/host.sources" ] ||
        fail "no entry for Debian $codename among this machine's apt sources"
}

mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$apt/sources.list.d"
: >"$apt/status"
write_sources
options=(-q -o "Dir::Etc::SourceList=$apt/sources.list" -o "Dir::Etc::SourceParts=$apt/sources.list.d"
    -o "Dir::State::Lists=$apt/lists" -o "Dir::State::status=$apt/status" -o "Dir::Cache=$apt/cache"
    -o APT::Sandbox::User=root)
echo "debian_source: fetching the source package of $package"
apt-get "${options[@]}" update
(cd "$part" && apt-get "${options[@]}" source --download-only "$package")
tar xf "$part/$package"_*.orig.tar.?z -C "$part/source" --strip-components=1
mv "$part/source" "$to"
rm -rf "$part"
