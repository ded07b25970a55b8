#!/usr/bin/env bash
# What `make interop` needs beyond Python: Wine for the Windows binary, Chromium for the page,
# valgrind, qemu for ARM, gcc with its sanitizers. Installs what is missing where it may; otherwise says
# what to install, and ends with 2.
set -euo pipefail

declare -A packages=([wine]="wine wine64" [valgrind]="valgrind" [chromium]="chromium" [chromedriver]="chromium-driver" [gcc]="gcc libc6-dev" [qemu-aarch64]="qemu-user libc6-arm64-cross")
missing=()
for tool in "${!packages[@]}"; do
  command -v "$tool" >/dev/null || missing+=(${packages[$tool]})
done
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi
if [ "$(id -u)" -ne 0 ] || ! command -v apt-get >/dev/null; then
  echo "missing for make interop: ${missing[*]}" >&2
  echo "install them, on Debian or Ubuntu with: sudo apt-get install ${missing[*]}" >&2
  exit 2
fi
echo "installing ${missing[*]}"
apt-get update -qq
DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
