#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# service.t - the unit under a real systemd: it starts in a container, gets what the programs need and no
# more, and does what the unit says after each kind of end. The container has the folder /usr of this
# machine and our programs above it. It needs root and systemd-nspawn; else everything is skipped.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Copy qw(copy);
use File::Path qw(make_path);
use File::Temp qw(tempdir);
use FindBin;
use Test::More;
use lib $FindBin::Bin;
use Files;

my $build = abs_path($ENV{BUILD} // 'build');
chdir dirname(__FILE__) . '/..' or die;
plan skip_all => 'only root starts a container' if $> != 0;
for my $tool (qw(systemd-nspawn unshare timeout)) {
	plan skip_all => "$tool is not installed" if system "command -v $tool >/dev/null 2>&1";
}
my $dir = tempdir(CLEANUP => 1);
my $root = "$dir/root";
make_path(map { "$root/$_" } qw(usr var/lib run dev proc sys tmp root share etc/default etc/ladder etc/systemd/system/multi-user.target.wants));
make_path("$dir/over/bin", "$dir/share");
symlink "usr/$_", "$root/$_" for grep { -l "/$_" } qw(bin sbin lib lib32 lib64 libx32);
for my $name (qw(ladderd ladder-guard ladder)) {
	copy("$build/$name", "$dir/over/bin/$name") or die;
	chmod 0755, "$dir/over/bin/$name";
}
spew("$root/etc/machine-id", '');
spew("$root/etc/os-release", "NAME=test\n");
spew("$root/etc/passwd", "root:x:0:0::/root:/bin/sh\nnobody:x:65534:65534::/:/bin/false\nmessagebus:x:100:100::/:/bin/false\n");
spew("$root/etc/group", "root:x:0:\nnogroup:x:65534:\nmessagebus:x:100:\ngpio:x:997:\nladder-eng:x:996:\n");
copy('packaging/ladderd.service', "$root/etc/systemd/system/ladderd.service") or die;
copy('packaging/ladderd.default', "$root/etc/default/ladderd") or die;
spew("$root/etc/ladder/active", "LADDERD_FILE=/etc/ladder/one.rung\nLADDERD_MAP=/etc/ladder/one.io\n");
spew("$root/etc/ladder/one.io", "BOARD \"x\"\n%QX0.0 sim safe=0\n");
spew("$root/etc/ladder/one.rung", <<'END');
RUNGBOARD 1

VAR
  Lamp AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO SYS_ALWAYS_ON | COIL Lamp |
END_PROGRAM
END
# Shorter times, so that the test is.
make_path("$root/etc/systemd/system/ladderd.service.d");
spew("$root/etc/systemd/system/ladderd.service.d/short.conf", "[Service]\nTimeoutStopSec=1\nRestartSec=100ms\nWatchdogSec=1\n[Unit]\nStartLimitBurst=20\n");
# What the unit may open, told by a command in it, which the unit itself would not run: a serial port, and what each unit may.
spew("$root/etc/systemd/system/ladderd.service.d/open.conf", "[Service]\nExecStartPre=/bin/sh /etc/open.sh\nExecPaths=-/bin/sh -/usr/bin/sh -/usr/bin/dash\n");
spew("$root/etc/open.sh", <<'END');
for name in port full; do
	(: <>/dev/$name) 2>/run/rungboard/$name || :
done
END
symlink '/usr/lib/systemd/system/multi-user.target', "$root/etc/systemd/system/default.target";
symlink "/dev/null", "$root/etc/systemd/system/$_" for qw(systemd-logind.service console-getty.service getty.target systemd-user-sessions.service);
symlink '../test.service', "$root/etc/systemd/system/multi-user.target.wants/test.service";
spew("$root/etc/systemd/system/test.service", <<'END');
[Unit]
SuccessAction=poweroff-force
FailureAction=poweroff-force
[Service]
Type=oneshot
SupplementaryGroups=ladder-eng
ExecStart=/bin/sh /etc/test.sh
END
spew("$root/etc/test.sh", <<'END');
exec >/share/out 2>&1
get() { systemctl show -P "$1" ladderd; }
ladderd_of() { read -r child _ <"/proc/$1/task/$1/children"; echo "$child"; }
# Waits until a property has a value, or another ladderd is the main process.
until_is() {
	for i in $(seq 200); do [ "$(get "$1")" != "$2" ] || return 0; sleep 0.05; done
	return 1
}
again() {
	for i in $(seq 200); do
		now=$(get MainPID)
		[ "$(get ActiveState)" != active ] || [ "$now" = "$1" ] || return 0
		sleep 0.05
	done
	return 1
}
mknod -m 666 /dev/port c 4 64
systemd-run -q --wait -p DevicePolicy=closed sh -c ': <>/dev/port' 2>/dev/null || echo 'devices closed'
(ulimit -r 50 && ulimit -l unlimited) 2>/dev/null && echo 'limits raised'
systemctl start ladderd; echo "start $? $(get ActiveState)"
[ ! -s /run/rungboard/port ] || echo 'port closed'
[ -s /run/rungboard/full ] || echo 'full open'
guard=$(get MainPID)
ladderd=$(ladderd_of "$guard")
read -r name <"/proc/$ladderd/comm"; echo "name $name"
sed -n 's/^Max \(realtime priority\|locked memory\) *\([a-z0-9]*\).*/\1 \2/p' "/proc/$ladderd/limits"
sed -n 's/^\(CapEff\|CapBnd\|NoNewPrivs\|Seccomp\):[[:space:]]*/\1 /p' "/proc/$ladderd/status"
sed -n 's/^Uid:[[:space:]]*\(.*\)/\1/p' "/proc/$ladderd/status" | grep -qw 0 || echo 'uid other'
ladder board unix:/run/rungboard/link status | sed -n 's/^mode: /mode /p'
ls /var/lib/rungboard
kill -9 "$ladderd"
until_is StatusText 'ladderd has died, outputs are safe'; echo "killed $? $(get ActiveState) $(get NRestarts)"
[ "$(get MainPID)" != "$guard" ] || echo 'guard same'
systemctl reload ladderd; echo "reload $?"
for i in $(seq 200); do ladder board unix:/run/rungboard/link status 2>/dev/null | grep -q '^mode: RUN' && break; sleep 0.05; done
ladderd=$(ladderd_of "$guard")
kill -9 "$guard"
again "$guard"; echo "guard-killed $? $(get NRestarts)"
ladder board unix:/run/rungboard/link status | sed -n 's/^before this start: /before /p'
guard=$(get MainPID)
kill -STOP "$guard"
again "$guard"; echo "guard-frozen $? $(get NRestarts)"
systemctl stop ladderd; echo "stop $? $(get ActiveState) $(get Result)"
echo LADDERD_FILE=/etc/ladder/nothing.rung >>/etc/ladder/active
systemctl start ladderd 2>/dev/null; echo "nothing $? $(get ActiveState) $(get Result)"
END
system "timeout -k 5 120 unshare -m sh -c 'mount --make-rprivate / && mount -t tmpfs tmpfs /run && exec systemd-nspawn -q --register=no " .
	"--keep-unit -D $root --overlay-ro=/usr:$dir/over:/usr --bind=$dir/share:/share -b' >$dir/boot </dev/null 2>&1";
my $out = slurp("$dir/share/out") // '';
plan skip_all => 'no container starts here' if $out !~ /^start /m;
sub said { my ($line, $what) = @_; like($out, qr/^$line$/m, $what) or diag($out) }
said('start 0 active', 'the unit starts: READY=1 came');
said('name ladderd', 'the guard runs, and its child is ladderd');
said('uid other', 'as an ordinary user');
said("$_ 0{16}", "$_: no right of root") for qw(CapEff CapBnd);
said('NoNewPrivs 1', 'and none can come');
said('Seccomp 2', 'its system calls are filtered');
SKIP: {
	skip 'no limit can be raised here', 2 if $out !~ /^limits raised$/m;
	said('realtime priority 50', 'it may have a priority in real time');
	said('locked memory unlimited', 'and lock its memory');
}
SKIP: {
	skip 'no device can be forbidden here', 1 if $out !~ /^devices closed$/m;
	said('port closed', 'a device that it does not need is forbidden');
}
said('full open', 'what each unit may open it may');
said('mode RUN', 'a desk reaches it in its folder of /run');
said('events', 'it stores in its folder of /var/lib');
said('killed 0 active 0', 'ladderd is killed: the service goes on');
said('guard same', 'with the same guard');
said('reload 0', 'a reload may run what it needs');
said('guard-killed 0 1', 'the guard is killed: systemd starts both again');
said('before ladderd ended', 'and that ladderd had ended in order');
said('guard-frozen 0 2', 'the guard stands still: WatchdogSec starts both again');
said('stop 0 inactive success', 'a stop is one');
said('nothing \d+ failed exit-code', 'a file that is not there: the service fails, and is not started again');
done_testing;
