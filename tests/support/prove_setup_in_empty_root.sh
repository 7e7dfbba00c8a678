#!/usr/bin/env bash
# What is here: proof that the package list is complete: an empty Debian 12 root (debootstrap, minbase), a clean `git archive` of HEAD in it,
# and the README's commands run there as root, without sudo, without standard input. Needs root and debootstrap; asks nothing.
# What is not: a test that CI runs (it downloads a system and takes about half an hour).
#
#   tests/support/prove_setup_in_empty_root.sh [--keep] [COMMAND ...]
#     COMMAND  one shell line each, run in the clone; default: './run quick' './run quick' './run test'
#     --keep   leave the root in place and say where it is (the default removes it)
# The Debian mirror is the one this machine's apt uses.
set -euo pipefail

keep=no
if [ "${1:-}" = --keep ]; then keep=yes; shift; fi
commands=("$@")
[ ${#commands[@]} -gt 0 ] || commands=('./run quick' './run quick' './run test')

if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap > /dev/null; then
  echo "prove_setup: needs root and the package debootstrap" >&2
  exit 1
fi
repository=$(git -C "$(dirname "${BASH_SOURCE[0]}")" rev-parse --show-toplevel)

# shellcheck disable=SC2016  # these are apt's own placeholders
mirror=$(apt-get indextargets --format '$(SITE) $(RELEASE)' 'Created-By: Packages' | awk '$2 == "bookworm" && !found {print $1; found = 1}')
if [ -z "$mirror" ]; then
  echo "prove_setup: apt on this machine knows no bookworm archive" >&2
  exit 1
fi
extra=()
case "$mirror" in https:*) extra=(--include=ca-certificates) ;; esac

root=$(mktemp -d /tmp/perfora-empty-root.XXXXXX)
chmod 755 "$root"  # apt fetches as a user of its own
cleanup() { if [ "$keep" = yes ]; then echo "prove_setup: root left in $root"; else rm -rf --one-file-system "$root"; fi; }
trap cleanup EXIT

echo "prove_setup: debootstrap bookworm (minbase) in $root"
debootstrap --variant=minbase "${extra[@]}" bookworm "$root" "$mirror" > "$root.log" 2>&1 || { tail -n 20 "$root.log" >&2; exit 1; }
rm -f "$root.log"
# The same archives, certificates and options as this machine's apt; nothing else comes from it.
for part in sources.list sources.list.d apt.conf.d auth.conf.d trusted.gpg.d keyrings; do
  [ -e "/etc/apt/$part" ] || continue
  rm -rf "$root/etc/apt/$part"
  cp -a "/etc/apt/$part" "$root/etc/apt/"
done
for file in /etc/resolv.conf /etc/hosts; do [ -e "$file" ] && cp -L "$file" "$root$file"; done
[ -d /usr/local/share/ca-certificates ] && cp -a /usr/local/share/ca-certificates "$root/usr/local/share/"

mkdir "$root/perfora"
git -C "$repository" archive HEAD | tar -x -C "$root/perfora"

for command in "${commands[@]}"; do
  echo "prove_setup: $command"
  start=$(date +%s)
  # A mount namespace of its own: /proc and the terminals go away with it, however the command ends.
  unshare --mount chroot "$root" env -i PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
    bash -c "mount -t proc proc /proc && mkdir -p /dev/pts && mount -t devpts -o newinstance,ptmxmode=666 devpts /dev/pts && cd /perfora && $command" < /dev/null || {
      echo "prove_setup: FAILED: $command (exit code $?)" >&2
      exit 1
    }
  echo "prove_setup: ok, $(($(date +%s) - start)) s: $command"
done
echo "prove_setup: all commands passed in an empty Debian 12 root"
