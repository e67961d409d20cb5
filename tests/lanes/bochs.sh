# Sourced by --matrix: run_in_bochs PROGRAM [WORD...] runs a static program on an emulated processor with AVX-512, and prints what it
# prints. No emulator of a process has AVX-512 (qemu 7.2 ends at AVX2), so Bochs emulates the whole machine, an Ice Lake, which boots a
# kernel of Debian's with nothing but that program. It has no power button: the last line that comes over its serial port ends it.
bochs_packages=(bochs bochs-term bochsbios isolinux syslinux-common xorriso busybox-static cpio)
bochs_seconds=5400 # for all: a minute to boot, and a hundredth of a processor's speed

# What Linux 6.1 must leave alone to come up on Bochs 2.7, whose sizes of saved registers, NMIs and counters are not those of the processor.
bochs_kernel_words="console=ttyS0 quiet nokaslr lsm=capability mitigations=off random.trust_cpu=on acpi=off idle=halt nowatchdog mce=off
    nopcid split_lock_detect=off clearcpuid=xsavec,xsaves,pku,aperfmperf,invpcid,smap,umip,fsrm,erms"

# bochs_kernel: downloads the kernel into $work/bochs, and installs none. False where it cannot.
bochs_kernel() {
    local package
    mkdir -p "$work/bochs"
    echo "apt-cache knows no linux-image-cloud-amd64" >"$work/bochs/log"
    package=$(apt-cache depends linux-image-cloud-amd64 2>/dev/null | sed -n 's/.*Depends: \(linux-image-[0-9].*\)/\1/p')
    [[ -n $package ]] && (cd "$work/bochs" && apt-get -qq download "$package" && dpkg-deb -x "$package"_*.deb .) 2>"$work/bochs/log"
}

run_in_bochs() {
    local here=$work/bochs root=$work/bochs/root disc=$work/bochs/disc pid
    rm -rf "$root" "$disc"
    mkdir -p "$root/bin" "$root/dev" "$disc/isolinux"
    cp /bin/busybox "$1" "$root/bin"
    {
        echo '#!/bin/busybox sh'
        printf '%q ' "/bin/${1##*/}" "${@:2}"
        printf '\n%s\n' 'echo "== ended"' 'while :; do :; done'
    } >"$root/init"
    chmod +x "$root/init"
    (cd "$root" && find . | cpio --quiet -o -H newc | gzip -1) >"$disc/initrd"
    cp "$here"/boot/vmlinuz* "$disc/kernel"
    cp /usr/lib/ISOLINUX/isolinux.bin /usr/lib/syslinux/modules/bios/ldlinux.c32 "$disc/isolinux"
    printf 'default gnomon\nlabel gnomon\n kernel /kernel\n append initrd=/initrd %s\n' "${bochs_kernel_words//$'\n'/ }" \
        >"$disc/isolinux/isolinux.cfg"
    xorriso -as mkisofs -quiet -o "$here/disc.iso" -b isolinux/isolinux.bin -c isolinux/boot.cat -no-emul-boot -boot-load-size 4 \
        -boot-info-table "$disc" 2>>"$here/log"
    cat >"$here/machine" <<END
cpu: model=corei7_icelake_u, ips=100000000, reset_on_triple_fault=0
memory: guest=1024, host=1024
romimage: file=/usr/share/bochs/BIOS-bochs-latest
vgaromimage: file=/usr/share/bochs/VGABIOS-lgpl-latest
display_library: term
ata0-master: type=cdrom, path="$here/disc.iso", status=inserted
boot: cdrom
com1: enabled=1, mode=file, dev=$here/serial
log: $here/bochs.log
clock: sync=none
panic: action=fatal
END
    echo c >"$here/begin" # Debian's Bochs has a debugger, which waits
    : >"$here/serial"
    TERM=vt100 timeout "$bochs_seconds" script -qec "bochs -q -f '$here/machine' -rc '$here/begin'" /dev/null \
        </dev/null >>"$here/log" 2>&1 & # which gives it the terminal that its screen needs
    pid=$!
    trap 'kill "$pid" 2>/dev/null || true' EXIT # of the pipeline's shell, if that is stopped
    tail -n +1 -s 1 -f --pid="$pid" "$here/serial" &
    while kill -0 "$pid" 2>/dev/null && ! grep -q '^== ended' "$here/serial"; do sleep 1; done
    kill "$pid" 2>/dev/null || echo "Bochs ended by itself: $(tail -n 1 "$here/bochs.log")"
    wait
}
