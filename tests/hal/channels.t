#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# channels.t - ladderd with analog values, from outside: a program that copies a temperature to a pulse width, with
# files in place of the kernel's. What goes wrong with a device is no fault of the program, and the pulse width is
# safe after each way out of RUN.
use strict;
use warnings;
use Test::More;
use File::Copy qw(copy);
use File::Path qw(make_path remove_tree);
use File::Temp qw(tempdir);
use FindBin;
use POSIX qw(mkfifo);
use Time::HiRes qw(sleep time);
use lib "$FindBin::Bin/..";
use Files;
use Limit;

my $build = $ENV{BUILD} || 'build';
my $ladderd = "$build/tests/hal/ladderd_v2";
my $dir = tempdir(CLEANUP => 1);
my $sys = "$dir/sys";
@Limit::show = ("$dir/err", "$dir/out");
delete @ENV{qw(NOTIFY_SOCKET WATCHDOG_USEC WATCHDOG_PID)};
$ENV{FAKE_SYS} = $sys;

sub put { return spew("$dir/$_[0]", $_[1]) }
sub get { return slurp("$dir/$_[0]") // '' }

# A file of the kernel.
sub show {
	my ($name, $text) = @_;
	(my $folder = "$sys/$name") =~ s{/[^/]*$}{};
	make_path($folder);
	spew("$sys/$name", $text);
}

my $sensor = 'bus/w1/devices/28-1/temperature';
sub make_devices {
	remove_tree($sys);
	show($sensor, "21437\n");
	show('class/pwm/pwmchip0/npwm', "1\n");
	show('class/pwm/pwmchip0/export', '');
	show("class/pwm/pwmchip0/pwm0/$_", '0') for qw(period duty_cycle enable);
}
# The number of a file: behind it may be the rest of an older one.
sub number_in { return get($_[0]) =~ /^(\d+)/ ? $1 : 0 }
sub duty { return number_in('sys/class/pwm/pwmchip0/pwm0/duty_cycle') }

my $rung = put('copy.rung', <<'END');
RUNGBOARD 1
PROJECT "Copy"

VAR_GLOBAL
  Warm  AT %AIW0  : INT;
  Power AT %AQW0  : INT;
  Good  AT %IX9.0 : BOOL;
  Lamp  AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO SYS_ALWAYS_ON | MOVE IN:=Warm OUT=>Power |
RUNG
  | NO Good | COIL Lamp |
END_PROGRAM
END
my $map = put('copy.io', <<'END');
BOARD "Copy"
%AIW0  w1  sensor=28-1 poll=20ms stale=500ms substitute=1000
%AQW0  pwm chip=pwmchip0 channel=0 period=20ms range=0..10000 at 0%..100% safe=4500
%IX9.0 quality of=%AIW0
%QX0.0 sim safe=0
END
my $safe = 9_000_000;

sub start {
	my (@args) = @_;
	unlink "$dir/out", "$dir/err";
	my $pid = fork;
	die "fork: $!" unless defined $pid;
	if (!$pid) {
		open STDOUT, '>>', "$dir/out" or die;
		open STDERR, '>>', "$dir/err" or die;
		open STDIN, '<', '/dev/null' or die;
		exec $ladderd, $rung, '--io', $map, @args;
		die "exec: $!";
	}
	return $pid;
}

# Asks for the status until it matches.
sub status_has {
	my ($pid, $want) = @_;
	return until_true(sub {
		put('out', '');
		kill 'USR1', $pid;
		return until_true(sub { get('out') =~ /^io: /m }) && get('out') =~ $want;
	});
}

# A temperature of 21.43 °C is 2144 hundredths, 21.44 % of 20 ms.
make_devices();
my $pid = start();
ok(until_true(sub { duty() == 4_288_000 }), 'what the program writes is at the output');
ok(status_has($pid, qr/^io: good.*\nchannels: 3 good, 0 stale, 0 in fault$/m), 'the status counts qualities');
show($sensor, "38000\n");
ok(until_true(sub { duty() == 7_600_000 }), 'it follows the input');
show($sensor, "wrong\n");
ok(until_true(sub { duty() == 2_000_000 }), 'a sensor that answers nonsense has its substitute');
ok(status_has($pid, qr/^state: RUN\n.*^io: fault.*^channels: 2 good, 0 stale, 1 in fault$/ms),
	'the status says so, and the program runs');
show($sensor, "30000\n");
ok(until_true(sub { duty() == 6_000_000 }), 'and it comes back');
unlink "$sys/$sensor";
mkfifo("$sys/$sensor", 0644) or die;
ok(until_true(sub { duty() == 2_000_000 }), 'one that does not answer is stale');
my ($before) = get('out') =~ /^scans: (\d+)/m;
ok(status_has($pid, qr/^io: stale/m), 'the status says so, too');
sleep 0.2;
ok(status_has($pid, qr/^io: stale/m) && get('out') =~ /^scans: (\d+)/m && $1 > $before, 'the scans go on');
kill 'TERM', $pid;
is(finish($pid), 0, 'SIGTERM ends it, though a thread hangs in its device');
is(duty(), $safe, '… with the safe value');

for my $case (['SIGSEGV', sub { kill 'SEGV', $_[0] }, 'signal 11'], ['SIGINT', sub { kill 'INT', $_[0] }, 0],
	      ['SIGABRT', sub { kill 'ABRT', $_[0] }, 'signal 6']) {
	my ($name, $act, $end) = @$case;
	make_devices();
	$pid = start();
	ok(until_true(sub { duty() == 4_288_000 }), "before $name it writes");
	$act->($pid);
	is(finish($pid), $end, $name);
	is(duty(), $safe, "after $name the output has its safe value");
}

# A loop without an end is a fault, then the outputs are safe until a reset.
$rung = put('loop.rung', <<'END');
RUNGBOARD 1
PROJECT "Loop"

VAR_GLOBAL
  Warm  AT %AIW0  : INT;
  Power AT %AQW0  : INT;
  Slow : TON;
END_VAR

PROGRAM Main LD
RUNG
  | NO SYS_ALWAYS_ON | MOVE IN:=Warm OUT=>Power |
RUNG
  | [ Warm < 3000 ] | RET |
RUNG Again
  | NO SYS_ALWAYS_ON | JMP Again |
END_PROGRAM
END
make_devices();
$pid = start();
ok(until_true(sub { duty() == 4_288_000 }), 'before a fault it writes');
show($sensor, "35000\n");
ok(until_true(sub { duty() == $safe }), 'a fault of the program makes the output safe');
ok(status_has($pid, qr/^state: FAULT/m), 'the state is FAULT');
show($sensor, "20000\n");
# The new temperature may not have been read yet: then it is a fault once more.
ok(until_true(sub { kill 'HUP', $pid; sleep 0.1; duty() == 4_000_000 }), 'after a reset it writes again');
kill 'TERM', $pid;
is(finish($pid), 0, 'it ends');

# ladder-guard makes the pulse width safe when ladderd is killed. Here ladderd cannot begin again, so nobody else writes.
sub start_guard {
	my (@ladderd) = @_;
	unlink "$dir/out", "$dir/err";
	my $pid = fork // die "fork: $!";
	if (!$pid) {
		open STDOUT, '>>', "$dir/out" or die;
		open STDERR, '>>', "$dir/err" or die;
		open STDIN, '<', '/dev/null' or die;
		exec "$build/ladder-guard", '--name', "channels-$$", '--', @ladderd;
		die "exec: $!";
	}
	return $pid;
}
sub child_of {
	my ($pid) = @_;
	for my $folder (glob '/proc/[0-9]*') {
		return $folder =~ s{.*/}{}r if (slurp("$folder/stat") // '') =~ /\) [^Z] $pid /;
	}
	return undef;
}
for my $hold (0, 1) {
	my $copied = "$dir/ladderd";
	copy($ladderd, $copied) or die;
	chmod 0755, $copied;
	my $its = $hold ? put('hold.io', slurp($map) =~ s/safe=4500/safe=hold/r) : $map;
	$rung = put('copy.rung', get('loop.rung') =~ s/^RUNG Again\n.*\n//mr);
	make_devices();
	$pid = start_guard($copied, $rung, '--io', $its);
	ok(until_true(sub { duty() == 4_288_000 }), 'under a guard it writes');
	unlink $copied;
	my $child = child_of($pid);
	kill 'KILL', $child if $child;
	ok(until_true(sub { get('err') =~ /ladderd died of signal 9; the outputs are safe/ }), 'ladderd is killed');
	is(duty(), $hold ? 4_288_000 : $safe, $hold ? 'an output that holds keeps its value' : 'the guard has made the pulse width safe');
	kill 'TERM', $pid;
	finish($pid);
	is(duty(), $hold ? 4_288_000 : $safe, 'it stays so when the guard ends');
}
make_devices();
$pid = start();
ok(until_true(sub { duty() == 4_288_000 }), 'it writes');
kill 'KILL', $pid;
is(finish($pid), 'signal 9', 'ladderd is killed');
is(duty(), 4_288_000, 'without a guard the pulse width stays');
# Frozen: killed by the guard, safe, and it begins again.
make_devices();
$pid = start_guard($ladderd, $rung, '--io', $map);
ok(until_true(sub { duty() == 4_288_000 }), 'it writes');
kill 'STOP', child_of($pid);
ok(until_true(sub { get('err') =~ /was frozen and is killed; the outputs are safe/ }), 'one that stands still is killed');
ok(until_true(sub { duty() == 4_288_000 }), 'and the next one writes again');
# A file that cannot be written any more is told; the rest goes on.
remove_tree("$sys/class/pwm");
kill 'KILL', child_of($pid);
ok(until_true(sub { get('err') =~ m{ladder-guard: "\S*/pwm0/duty_cycle" is not safe: No such file or directory; the guard tries again} }),
	'an output that is gone is told');
kill 'TERM', $pid;
finish($pid);

# A chip comes back with another number, and its old one is that of another chip: the guard writes the right one.
sub make_chip { # a link in the class, as the kernel makes it
	my ($device, $number) = @_;
	my $at = "devices/$device/pwm/pwmchip$number";
	show("$at/npwm", "1\n");
	show("$at/export", '');
	show("$at/pwm0/$_", '0') for qw(period duty_cycle enable);
	symlink '../../../' . $device =~ s{.*/}{}r, "$sys/$at/device" or die;
	make_path("$sys/class/pwm");
	symlink "../../$at", "$sys/class/pwm/pwmchip$number" or die;
}
sub duty_of { return number_in("sys/class/pwm/pwmchip$_[0]/pwm0/duty_cycle") }
# The last word: the number that a chip of the same name, which was there from the start, has in the end.
for my $case (['at its place', '1-0040', '1-0040', '', 1], ['elsewhere, by its name', '1-0040', '1-0041', "pca9685\n", 1],
	      ['elsewhere, without a name', '1-0040', '1-0041', '', 0], ['gone', '1-0040', undef, '', 0],
	      ['gone, and another one has its name', '1-0040', undef, "pca9685\n", 0, 1],
	      ['gone, and another one has its name and its number', '1-0040', undef, "pca9685\n", 0, 0],
	      ['elsewhere, and another one has its name', '1-0040', '1-0041', "pca9685\n", 0, 0],
	      ['at its place, and another one has its name', '1-0040', '1-0040', "pca9685\n", 1, 0]) {
	my ($how, $was, $is, $name, $found, $twin) = @$case;
	my $copied = "$dir/ladderd";
	copy($ladderd, $copied) or die;
	chmod 0755, $copied;
	make_devices();
	remove_tree("$sys/class/pwm");
	make_chip("i2c-1/$was", 0);
	show("devices/i2c-1/$was/name", $name) if $name;
	if (defined $twin) {
		make_chip('i2c-2/2-0040', 1);
		show('devices/i2c-2/2-0040/name', $name);
	}
	my $its = put('named.io', slurp($map) =~ s/pwmchip0/$was/r);
	$pid = start_guard($copied, $rung, '--io', $its);
	ok(until_true(sub { duty_of(0) == 4_288_000 }), "$how: it writes");
	my $child = child_of($pid); # a guard that is late has killed it already
	kill 'STOP', $child;
	unlink $copied;
	unlink "$sys/class/pwm/pwmchip0";
	remove_tree("$sys/devices/i2c-1/$was");
	if (!$twin) {
		unlink "$sys/class/pwm/pwmchip1";
		remove_tree("$sys/devices/i2c-2");
		make_chip('i2c-2/2-0040', 0);
		show('devices/i2c-2/2-0040/name', $name) if defined $twin;
	}
	if ($is) {
		make_chip("i2c-1/$is", 3);
		show("devices/i2c-1/$is/name", $name) if $name;
	}
	kill 'KILL', $child;
	my $told = qr{ladder-guard: "\S*/pwmchip0/pwm0/duty_cycle" is not safe: No such device; the guard tries again};
	ok(until_true(sub { $found ? duty_of(3) == $safe : get('err') =~ $told }),
		$found ? 'the guard finds the chip' : 'the guard tells that it is not there');
	is(duty_of($twin // 0), 0, 'and does not touch the other chip');
	is(duty_of(3), 0, 'nor this one') if $is && !$found;
	kill 'TERM', $pid;
	finish($pid);
}

# More outputs than the guard has room for: the ones that it knows are made safe, the others are told. First one chip with
# many channels: ladderd tells. Then many chips, each in a folder with a long name: the guard tells.
for my $case ([1, 70, '', qr{ladderd: ladder-guard knows (\d+) outputs of converters; the others are not made safe by it}],
	      [30, 1, 'x' x 190, qr{ladder-guard: "\S*/pwmchip(\d+)/pwm0/duty_cycle" is not made safe: the guard has no room for it}]) {
	my ($chips, $channels, $long, $told) = @$case;
	my $copied = "$dir/ladderd";
	copy($ladderd, $copied) or die;
	chmod 0755, $copied;
	make_devices();
	remove_tree("$sys/class/pwm");
	my ($lines, $at) = ("BOARD \"Many\"\n%AIW0 sim\n%IX9.0 sim\n%QX0.0 sim safe=0\n", 0);
	for my $chip (0 .. $chips - 1) {
		make_chip("$long-$chip/1-0040", $chip);
		show("devices/$long-$chip/1-0040/pwm/pwmchip$chip/npwm", "$channels\n");
		for my $channel (0 .. $channels - 1) {
			show("devices/$long-$chip/1-0040/pwm/pwmchip$chip/pwm$channel/$_", '0') for qw(period duty_cycle enable);
			$lines .= sprintf "%%AQW%d pwm chip=pwmchip%d channel=%d period=20ms range=0..10000 at 0%%..100%% safe=4500\n",
				2 * $at++, $chip, $channel;
		}
	}
	my @duty = map { my $chip = $_; map { "sys/class/pwm/pwmchip$chip/pwm$_/duty_cycle" } 0 .. $channels - 1 } 0 .. $chips - 1;
	$pid = start_guard($copied, $rung, '--io', put('many.io', $lines));
	ok(until_true(sub { number_in('sys/class/pwm/pwmchip0/pwm0/enable') == 1 && get('err') =~ $told }), 'too many outputs are told');
	my ($known) = get('err') =~ $told;
	my $are_safe = sub { scalar grep { number_in($_) == $safe } @duty };
	ok(until_true(sub { $are_safe->() == 0 }), 'the program has written them all');
	unlink $copied;
	kill 'KILL', child_of($pid);
	ok(until_true(sub { get('err') =~ /ladderd died of signal 9; / }), 'ladderd is killed');
	is($are_safe->(), $known, "the $known outputs that the guard knows are safe");
	like(get('err'), qr/signal 9; not all outputs are safe/, 'and it says that not all are') if $long;
	kill 'TERM', $pid;
	finish($pid);
}

# All lines of a wrong map are told, and nothing is driven.
$map = put('wrong.io', <<'END');
BOARD "Wrong"
%AIW0  w1  sensor=28-2
%AQW0  pwm chip=pwmchip0 channel=0 period=20ms safe=4500
%AQW2  pwm chip=pwmchip9 channel=0 period=20ms safe=4500
%AIW4  hwmon device=cpu_thermal channel=temp1
END
make_devices();
is(finish(start()), 1, 'a map with devices that are not there is refused');
like(get('err'), qr/:2:1: error LD550: "28-2": this machine has no such device; it has 28-1; `ladder io` lists all$/m, 'the sensor');
like(get('err'), qr/:4:1: error LD550: "pwmchip9": this machine has no such device; it has pwmchip0; `ladder io` lists all$/m, 'the chip');
like(get('err'), qr/:5:1: error LD550: "cpu_thermal": this machine has no such device; `ladder io` lists all$/m, 'the device');
is(duty(), 0, 'nothing is driven');
done_testing();
