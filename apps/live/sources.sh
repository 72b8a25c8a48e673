#!/bin/sh
# sources.sh FOLDER - gets the sources of GSL and libyaml from Debian into FOLDER, for apps/live. It needs apt-get and
# dpkg-dev, and no root: apt's lists are kept in FOLDER, the system's are not touched.
set -eu
[ $# -eq 1 ] || { echo "usage: sh sources.sh FOLDER" >&2; exit 2; }
mkdir -p "$1"
cd "$1"
release=$(. /etc/os-release && echo "$VERSION_CODENAME")
keys=/usr/share/keyrings/debian-archive-keyring.gpg
mkdir -p apt/lists/partial apt/cache/archives/partial
echo "deb-src [signed-by=$keys] http://deb.debian.org/debian $release main" >apt/sources.list
# own ARGUMENT...: apt-get with lists of its own
own() {
    apt-get -qq -o Dir::Etc::sourcelist="$PWD/apt/sources.list" -o Dir::Etc::sourceparts=- \
        -o Dir::State="$PWD/apt" -o Dir::State::status=/var/lib/dpkg/status -o Dir::Cache="$PWD/apt/cache" \
        -o APT::Sandbox::User="" "$@"
}
own update
own source gsl libyaml
