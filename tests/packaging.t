#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# packaging.t - what a package puts on a board, as far as it can be tested without building one
# (`make check-deb` does that): the sandbox of the unit, a service without a program, the offered
# part of sshd's configuration, the version.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use IO::Socket::UNIX;
use POSIX ();
use Socket qw(MSG_DONTWAIT);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Limit;

my $build = abs_path($ENV{BUILD} // 'build');
chdir dirname(__FILE__) . '/..' or die;
my $dir = tempdir(CLEANUP => 1);
sub get { my ($name) = @_; open my $f, '<', $name or return ''; local $/; return <$f> // '' }
sub has { my ($tool) = @_; return !system "command -v $tool >/dev/null 2>&1" }

my $unit = get('packaging/ladderd.service');
SKIP: {
	skip 'no systemd-analyze', 1 unless has('systemd-analyze');
	my $said = `systemd-analyze security --offline=true packaging/ladderd.service 2>&1`;
	my ($exposure) = $said =~ /exposure level.*?: ([\d.]+)/;
	skip 'systemd-analyze cannot look at a file here', 1 unless defined $exposure;
	ok($exposure <= 1.5, "the unit is exposed by $exposure, at most 1.5");
}
is_deeply([$unit =~ /^RestrictAddressFamilies=(.*)$/mg], ['AF_UNIX'], 'sockets of this machine only');
# ladder-modbus has the network and serial lines, and nothing else that ladderd has not.
my $modbus = get('packaging/ladder-modbus.service');
is_deeply([$modbus =~ /^(ExecStart|SupplementaryGroups|CapabilityBoundingSet|RestrictAddressFamilies)=(.*)$/mg],
	['ExecStart', '/usr/bin/ladder-modbus', 'SupplementaryGroups', 'ladder-io dialout', 'CapabilityBoundingSet', 'CAP_NET_BIND_SERVICE',
	'RestrictAddressFamilies', 'AF_UNIX AF_INET AF_INET6'], 'what ladder-modbus may do');
my %own = map { $_ => 1 } qw(PrivateNetwork=yes NotifyAccess=main PrivateUsers=no);
is_deeply([grep { !$own{$_} && index($modbus, "\n$_\n") < 0 } $unit =~ /^((?:No|Private|Protect|Restrict[NS]|RemoveIPC|LockP|MemoryDeny|DynamicUser)\w*=(?:yes|strict|invisible))$/mg],
	[], 'and it is shut in as ladderd is');
# Libraries may be executed, nothing else: also a libgpiod that was built on the board.
is_deeply([$unit =~ /^NoExecPaths=(.*)\n/mg, map { split } $unit =~ /^ExecPaths=(.*)$/mg],
	[qw(/ /usr/bin/ladder-guard /usr/bin/ladderd -/usr/lib -/usr/lib64 -/usr/local/lib -/lib -/lib64 -/bin/kill -/usr/bin/kill)], 'what may be executed');
like($unit, qr/^$_$/m, $_) for 'PrivateNetwork=yes', 'DynamicUser=yes', 'CapabilityBoundingSet=', 'NoNewPrivileges=yes', 'DevicePolicy=closed';

# ladder-peer is in the network, and has nothing else.
my $peer = get('packaging/ladder-peer.service');
is_deeply([$peer =~ /^RestrictAddressFamilies=(.*)$/mg], ['AF_UNIX AF_INET AF_NETLINK'], 'ladder-peer: its sockets');
is_deeply([$peer =~ /^NoExecPaths=(.*)\n/mg, map { split } $peer =~ /^ExecPaths=(.*)$/mg],
	[qw(/ /usr/bin/ladder-peer -/usr/lib -/usr/lib64 -/usr/local/lib -/lib -/lib64)], 'ladder-peer: what may be executed');
like($peer, qr/^$_$/m, "ladder-peer: $_") for 'DynamicUser=yes', 'SupplementaryGroups=ladder-io', 'CapabilityBoundingSet=', 'NoNewPrivileges=yes', 'DevicePolicy=closed', 'CPUQuota=20%';

# Whoever lets ladderd set the clock gives away nothing else.
is_deeply([sort grep { !/^(#|\[|$)/ } split /\n/, get('packaging/ladderd-clock.conf')],
	[sort qw(AmbientCapabilities=CAP_SYS_TIME CapabilityBoundingSet=CAP_SYS_TIME ProtectClock=no SystemCallFilter=@clock)], 'the right to set the clock');

# The unit without /etc/ladder/active: FILE and MAP are empty.
my $pid = fork // die;
if (!$pid) {
	open STDOUT, '>', "$dir/out"; open STDERR, '>&', *STDOUT;
	exec "$build/ladderd", '', '--io', '', '--link', "$dir/link", '--slots', $dir or die;
}
for (1 .. 600) { last if -S "$dir/link" || waitpid($pid, 1) == $pid; select undef, undef, undef, 0.05 }
ok(-S "$dir/link", 'without a program the service waits for one') or diag(get("$dir/out"));
like(get("$dir/out"), qr/no program yet: STOP/, 'in STOP');
kill 'TERM', $pid;
waitpid $pid, 0;
is(system("$build/ladderd '' --io '' >$dir/out 2>&1") >> 8, 2, 'without slots that is wrong usage');
like(get("$dir/out"), qr/FILE is missing/, 'and says so');

like($unit, qr{^ExecStart=/usr/bin/ladder-guard \$GUARD_OPTIONS -- /usr/bin/ladderd }m, 'the guard starts ladderd');
is_deeply([$unit =~ /^(NotifyAccess|KillMode|Type)=(.*)$/mg], [qw(Type notify NotifyAccess main KillMode control-group)],
	'and speaks alone with systemd; each of the two may end in order');
unlike(join('', map { get("packaging/$_") } qw(ladderd.service ladderd.default ladderd-run ladderd.procd)), qr/^[^#]*watchdog \/dev/m,
	'nobody opens the watchdog device unasked');

sub put { my ($name, $text) = @_; open my $f, '>', $name or die; print $f $text; close $f }
mkdir "$dir/$_" for qw(bin etc run);
symlink "$build/ladderd", "$dir/bin/ladderd" or die;
put("$dir/one.rung", "RUNGBOARD 1\n\nVAR\n  Lamp AT %QX0.0 : BOOL;\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n  | NO SYS_ALWAYS_ON | COIL Lamp |\nEND_PROGRAM\n");
put("$dir/one.io", "BOARD \"x\"\n%QX0.0 sim safe=0\n");
put("$dir/etc/active", "LADDERD_FILE=$dir/one.rung\nLADDERD_MAP=$dir/one.io\n");
put("$dir/default", "LADDERD_OPTIONS=\"--period 10ms\"\nGUARD_OPTIONS=\"--name packaging-$$\"\n");
sub ladderd_of { my ($parent) = @_; my ($pid) = get("/proc/$parent/task/$parent/children") =~ /^(\d+)/; return $pid // 0 }

# The command of the unit, with what the unit and the two files say, as systemd makes words of it: "${A}" is
# one word, "$A" is split.
my %set = map { map { split /=/, $_, 2 } split } $unit =~ /^Environment=(.*)$/mg;
my $files = get('packaging/ladderd.default') . get("$dir/etc/active");
$set{$1} = $2 while $files =~ /^(\w+)="?(.*?)"?$/mg;
s{/(var/lib|run)/rungboard}{$dir/state}g for values %set;
my ($words) = $unit =~ /^ExecStart=(.*)$/m;
my @command = map { /^\$\{(\w+)\}$/ ? $set{$1} : /^\$(\w+)$/ ? split(' ', $set{$1}) : s{^/usr/bin/}{$build/}r } split ' ', $words;
splice @command, 1, 0, '--name', "unit-$$";
my ($watchdog_s) = $unit =~ /^WatchdogSec=(\d+)$/m;
mkdir "$dir/state";
my $socket = IO::Socket::UNIX->new(Type => SOCK_DGRAM, Local => "$dir/notify") or die;
# Waits for a message of the service.
sub told { my ($want) = @_; return until_true(sub { my $text = ''; $socket->recv($text, 200, MSG_DONTWAIT); return $text eq $want }) }
sub start_unit {
	my $pid = fork // die;
	return $pid if $pid;
	@ENV{qw(NOTIFY_SOCKET WATCHDOG_USEC)} = ("$dir/notify", $watchdog_s * 1e6);
	delete $ENV{WATCHDOG_PID};
	open STDOUT, '>', "$dir/unit.out"; open STDERR, '>&', *STDOUT;
	exec @command or die;
}
my $service = start_unit();
ok(told('READY=1'), 'the command of the unit says that it is ready') or diag(get("$dir/unit.out"));
ok(told('WATCHDOG=1'), 'and feeds the watchdog of the service');
ok(-S "$dir/state/link" && -e "$dir/state/events", 'with the link and the log of its options');
my $died = ladderd_of($service);
kill 'KILL', $died;
ok(told('STATUS=ladderd has died, outputs are safe'), 'a death of ladderd is told');
ok(told('READY=1'), 'the next one is ready, in the same service');
ok(told('WATCHDOG=1'), 'which is still fed');
kill 'TERM', $service;
ok(told('STOPPING=1'), 'SIGTERM: it says that it stops');
ok(until_true(sub { waitpid($service, 1) == $service }) && $? == 0, 'and ends with status 0');
$service = start_unit();
told('READY=1');
my $left = ladderd_of($service);
kill 'KILL', $service;
waitpid $service, 0;
is($? & 127, 9, 'a guard that is killed has died of a signal: that is abnormal, so systemd starts it again');
ok(until_true(sub { !-e "/proc/$left" || get("/proc/$left/stat") =~ /\) Z/ }), 'its ladderd has ended');
is(unpack('x8 C', get("$dir/state/ends")), 0, 'in order: it has noted that');
$set{LADDERD_FILE} = "$dir/nothing.rung";
@command = ($command[0], '--name', "unit-$$", '--', "$build/ladderd", $set{LADDERD_FILE}, '--io', $set{LADDERD_MAP});
$service = start_unit();
ok(until_true(sub { waitpid($service, 1) == $service }) && $? >> 8 == 2, 'a file that cannot be read: status 2, which is no abnormal end: it is not started again');
like($unit, qr/^Restart=on-abnormal$/m, 'as the unit says');

# ladderd-run with and without a guard beside it.
my @env = ("LADDERD_FOLDER=$dir/etc", "LADDERD_DEFAULT=$dir/default", "LADDERD_RUN=$dir/run", "PATH=$dir/bin:$ENV{PATH}");
# Before it has handlers, a signal ends it.
sub listens {
	my ($pid) = @_;
	return until_true(sub {
		my ($caught) = $pid->() && get('/proc/' . $pid->() . '/status') =~ /^SigCgt:\s*\S*(\S{8})$/m;
		return $caught && hex($caught) & 1 << POSIX::SIGHUP() - 1;
	});
}
for my $guarded (0, 1) {
	symlink "$build/ladder-guard", "$dir/bin/ladder-guard" or die if $guarded;
	unlink "$dir/run/ladderd.status";
	my $run = fork // die;
	if (!$run) {
		open STDOUT, '>', "$dir/run/out"; open STDERR, '>&', *STDOUT;
		exec 'env', @env, 'sh', 'packaging/ladderd-run' or die;
	}
	my $comm = $guarded ? 'ladder-guard' : 'ladderd';
	ok(until_true(sub { get("/proc/$run/comm") eq "$comm\n" }), "ladderd-run becomes $comm");
	my $ladderd = sub { return $guarded ? ladderd_of($run) : $run };
	ok(listens($ladderd), 'ladderd listens to signals');
	like(`env @env sh packaging/ladderd-run status`, qr/^state: RUN$/m, 'its status is that of ladderd') or diag(get("$dir/run/out"));
	if ($guarded) {
		my $first = ladderd_of($run);
		kill 'KILL', $first if $first;
		ok(until_true(sub { my $now = ladderd_of($run); $now && $now != $first }), 'a ladderd that was killed is started again');
	}
	listens($ladderd);
	kill 'TERM', $run;
	ok(until_true(sub { waitpid($run, 1) == $run }) && $? == 0, 'SIGTERM ends it');
}

my ($version) = get('runtime/engine/base/version.h') =~ /LADDER_VERSION "(.*)"/;
like(get('packaging/debian/changelog'), qr/^rungboard \(\Q$version\E\) /, 'the package has the version of the programs');
SKIP: {
	skip 'no shellcheck', 1 unless has('shellcheck');
	is(`shellcheck -s sh packaging/deb.sh packaging/debian/rungboard-runtime.p* 2>&1`, '', 'shellcheck has nothing to say about the scripts');
}
done_testing();
