#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# guard.t - ladder-guard with a ladderd that is killed, crashes, freezes or hangs: the outputs get
# their safe values each time, and ladderd begins again as it shall. Both share lines of a fake
# (guard_fake.c). It prints how long that takes, and fails for no time. GUARD_KILLS, GUARD_STOPS,
# GUARD_SWAPS and GUARD_HANGS say how often.
use strict;
use warnings;
use Test::More;
use Fcntl qw(:flock SEEK_SET);
use File::Temp qw(tempdir);
use FindBin;
use IO::Socket::UNIX;
use Socket qw(MSG_DONTWAIT);
use POSIX ();
use Time::HiRes qw(sleep clock_gettime CLOCK_MONOTONIC);
use lib "$FindBin::Bin/..";
use Files;
use Limit;

my $build = $ENV{BUILD} || 'build';
my ($guard, $ladderd) = map { "$build/tests/hal/guarded_$_" } qw(guard ladderd);
my $kills = $ENV{GUARD_KILLS} || 20;
my $stops = $ENV{GUARD_STOPS} || 4;
my $dir = tempdir(CLEANUP => 1);
delete @ENV{qw(NOTIFY_SOCKET WATCHDOG_USEC WATCHDOG_PID)};
@Limit::show = ("$dir/err", "$dir/out");
my $running;

mkdir "$dir/dev";
spew("$dir/dev/gpiochip0", '');
@ENV{qw(FAKE_DEV FAKE_SHARED)} = ("$dir/dev", "$dir/lines");
# In RUN: Motor 1, Brake 0. Safe: Motor 0, Brake 1.
my $rung = spew("$dir/run.rung", <<'END');
RUNGBOARD 1

VAR
  Motor AT %QX0.0 : BOOL;
  Brake AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO SYS_ALWAYS_ON | COIL Motor |
RUNG
  | NC SYS_ALWAYS_ON | COIL Brake |
END_PROGRAM
END
my $map = spew("$dir/run.io", <<'END');
BOARD "panel"

%QX0.0 gpio line=OUT0 safe=0
%QX0.1 gpio line=OUT1 safe=1
END
my @ladderd = ($ladderd, $rung, '--io', $map);

our $count = 6; # lines of the chip
our $user = $>; # of the guard
sub fresh { spew("$dir/lines", "\0" x (56 * $count + 24)) }
# Sets the level of an input, or how reads behave (guard_fake.c).
sub poke {
	my ($at, $packed) = @_;
	open my $file, '+<:raw', "$dir/lines" or die;
	sysseek $file, $at, SEEK_SET;
	syswrite $file, $packed;
}
sub input { my ($line, $level) = @_; poke(56 * $line + 8, pack 'l', $level) }
sub reads { my ($how) = @_; poke(56 * $count, pack 'q', $how) }
# Since when a read waits, in s.
sub waits_since { return unpack('q', substr slurp("$dir/lines"), 56 * $count + 16) / 1e9 }
sub err { return slurp("$dir/err") // '' }

# Of each output: level, consumer, time in s of the last write; time and level when the guard took
# it last, which stay when ladderd runs again sooner than a test looks.
sub lines {
	my $bytes = slurp("$dir/lines");
	return map { my ($ns, $level, $owner, $guard_ns, $guard_level, $changes) = unpack 'q l Z20 q q q', substr $bytes, 56 * $_, 56;
		[$level, $owner, $ns / 1e9, $guard_ns / 1e9, $guard_level, $changes] } 2 .. $count - 1;
}
sub is_at {
	my ($owner, $motor, $brake) = @_;
	my @line = (lines())[0, 1];
	return $line[0][0] == $motor && $line[1][0] == $brake && !grep { $_->[1] ne $owner } @line;
}
sub runs { return is_at('ladderd', 1, 0) }
# Waits for a moment that is soon over.
sub until_quick {
	my ($what) = @_;
	for (1 .. 200000) {
		return 1 if $what->();
	}
	return 0;
}
my $names = 0;
sub start {
	my (@args) = @_;
	unlink "$dir/err";
	my $pid = fork // die "fork: $!";
	if (!$pid) {
		open STDOUT, '>', "$dir/out" or die;
		open STDERR, '>', "$dir/err" or die;
		open STDIN, '<', '/dev/null' or die;
		# A session of its own: when the shell above ends, the kernel lets the stopped processes of its jobs go on.
		POSIX::setsid();
		$user == $> or POSIX::setuid($user) or die;
		exec $guard, @args;
		die "exec: $!";
	}
	return $running = $pid;
}
sub named { return ('--name', "test-$$-" . ++$names) }
# The ladderd of a guard.
sub child {
	my ($pid) = @_;
	for my $folder (glob '/proc/[0-9]*') {
		my $text = slurp("$folder/stat") // next;
		return $folder =~ s{.*/}{}r if $text =~ /\) [^Z] $pid /;
	}
	die "no ladderd runs: " . err();
}
sub is_state { my ($pid, $state) = @_; return (slurp("/proc/$pid/stat") // '') =~ /\) $state/ }
sub median { my @all = sort { $a <=> $b } @_; return $all[$#all / 2] }

# The time at which the guard wrote the outputs, after a moment; undef: never.
sub guarded_since {
	my ($since) = @_;
	my $at;
	until_true(sub {
		my @line = (lines())[0, 1];
		my ($last) = sort { $b <=> $a } map { $_->[3] } @line;
		$at = $last if $line[0][4] == 0 && $line[1][4] == 1 && !grep { $_->[3] < $since } @line;
		return defined $at;
	});
	return $at;
}

# A desk of this machine. Without a slot folder only the guard counts ends.
spew("$dir/group", "ladder-eng:x:" . (split ' ', $))[0] . ":\n");
my @linked = ('--link', "$dir/link", '--groups', "$dir/group");
sub board { return scalar `$build/ladder board unix:$dir/link @_ 2>&1` }
# The numbers $wanted and both arguments, of each event.
sub events {
	my ($wanted) = @_;
	my $bytes = slurp("$dir/slots/events") // '';
	return join ', ', map { my (undef, undef, $id, undef, undef, @args) = unpack 'V q< C C v/a v/a v/a', substr $bytes, 256 * $_, 256;
		$id =~ /^(?:$wanted)$/ ? join ' ', $id, grep { length } @args : () } 0 .. int(length($bytes) / 256) - 1;
}

# ---- deaths and freezes at random moments ----
# A guard of its own for two ends each: a third within a minute begins in STOP.
for my $how (['kills', $kills, qw(SEGV FPE BUS ABRT KILL)], ['stops', $stops, 'STOP']) {
	my ($what, $count, @signals) = @$how;
	my (@took, $bad, $again);
	for my $number (1 .. $count) {
		if ($number % 2) {
			fresh();
			start(named(), '--heartbeat', 100, '--', @ladderd);
		}
		until_true(\&runs);
		my $pid = child($running);
		sleep rand 0.02;
		my $since = clock_gettime(CLOCK_MONOTONIC);
		kill $signals[$number % @signals], $pid;
		my $at = guarded_since($since);
		defined $at ? push(@took, $at - $since) : $bad++;
		$again++ if until_true(\&runs) && child($running) != $pid;
		next if $number % 2 && $number < $count;
		kill 'TERM', $running;
		finish($running);
	}
	ok(!$bad, "$count $what: both outputs are safe each time");
	is($again, $count, "$count $what: ladderd runs again");
	diag(sprintf '%d %s: safe after p50 %.1f ms, max %.1f ms', $count, $what, 1e3 * median(@took),
		1e3 * (sort { $b <=> $a } @took)[0]) if @took;
}

# ---- each way out of RUN, each safe value ----
# Columns: an output of this kind, its level in RUN, and the one after each way out; more kinds of
# outputs come here. Rows: what ends RUN; `state` is that of ladderd, if it lives; `again`: it runs again.
my @kinds = (['off', 'gpio line=OUT0 safe=0', 1, 0], ['on', 'gpio line=OUT1 safe=1', 0, 1],
	['hold', 'gpio line=OUT2 safe=hold', 1, 1], ['hold, active-low', 'gpio line=OUT3 active-low safe=hold', 1, 1]);
my $stop_rung = "RUNG\n  | NO Go | STOP |\n";
my @ways = (
	['STOP', $stop_rung, sub { input(0, 1) }, 'STOP'],
	# Its loop ends by the budget: on a slow machine, too, before the watchdog ends it.
	['program fault', "RUNG Again\n  | NO Go | JMP Again |\n", sub { input(0, 1) }, 'FAULT', undef, '--watchdog', 1000],
	['watchdog', '', sub { reads(2) }, 'FAULT', sub { reads(0) }],
	['I/O fault', '', sub { reads(1) }, 'FAULT'],
	['SIGTERM', '', sub { kill 'TERM', $running }, ''],
	['kill -9', '', sub { kill 'KILL', child($running) }, 'again'],
);
my ($vars, $rungs, $lines) = ('', '', '');
for my $i (0 .. $#kinds) {
	my ($name, $line, $in_run) = @{$kinds[$i]};
	$vars .= "  Out$i AT %QX0.$i : BOOL;\n";
	$rungs .= 'RUNG' . "\n  | " . ($in_run ? 'NO' : 'NC') . " SYS_ALWAYS_ON | COIL Out$i |\n";
	$lines .= "%QX0.$i $line\n";
}
my @in_run = map { my ($name, $line, $value) = @$_; $value ^ ($line =~ /active-low/ ? 1 : 0) } @kinds;
my @safe = map { my ($name, $line, $run, $value) = @$_; $value ^ ($line =~ /active-low/ ? 1 : 0) } @kinds;
sub levels { return join ' ', map { $_->[0] } (lines())[0 .. $#kinds] }
my $ways_map = spew("$dir/ways.io", "BOARD \"panel\"\n%IX0.0 gpio line=IN0\n$lines");
for my $way (@ways) {
	my ($name, $rung_of, $do, $state, $then, @options) = @$way;
	my $ways_rung = spew("$dir/ways.rung", "RUNGBOARD 1\n\nVAR\n  Go AT %IX0.0 : BOOL;\n${vars}END_VAR\n\nPROGRAM Main LD\n$rungs${rung_of}END_PROGRAM\n");
	fresh();
	my $guard_pid = start(named(), '--heartbeat', 1000, '--', $ladderd, $ways_rung, '--io', $ways_map, '--period', '10ms', @options);
	until_true(sub { levels() eq "@in_run" });
	my @changes = map { $_->[5] } lines();
	my $pid = child($guard_pid);
	$do->();
	my @got;
	if ($state eq 'again') {
		ok(until_true(sub { my @line = lines(); !grep { !$_->[3] } @line[0 .. $#kinds] }), "$name: the guard takes the lines");
		@got = map { $_->[4] } (lines())[0 .. $#kinds];
	} else {
		until_true(sub { levels() eq "@safe" });
		is(finish($guard_pid), 0, 'the guard ends with status 0') if $state eq '';
		@got = split / /, levels();
	}
	is($got[$_], $safe[$_], "$name: $kinds[$_][0]") for 0 .. $#kinds;
	if ($state eq 'again') {
		ok(until_true(sub { levels() eq "@in_run" && child($guard_pid) != $pid && err() !~ /STOP/ }), "$name: it runs again");
	}
	# What holds its level has not changed it, not even for a moment, also over another start.
	is_deeply([map { (lines())[$_][5] } 2, 3], [@changes[2, 3]], "$name: what holds was not touched");
	next if $state eq '';
	$then->() if $then;
	if ($state ne 'again') {
		until_true(sub { kill 'USR1', $pid; sleep 0.02; (slurp("$dir/out") // '') =~ /^state: $state/m });
		like(slurp("$dir/out"), qr/^state: $state/m, "$name: the state is $state");
	}
	kill 'TERM', $guard_pid;
	finish($guard_pid);
}

# ---- three abnormal ends: STOP ----
fresh();
my $pid = start(named(), '--', @ladderd, @linked);
for my $time (1 .. 3) {
	until_true(\&runs);
	kill 'KILL', child($pid);
	until_true(sub { err() =~ /(?:died of signal 9.*){$time}/s });
}
ok(until_true(sub { err() =~ /3 times within 60 s: it begins in STOP/ }), 'the third death is told');
ok(until_true(sub { is_at('ladderd', 0, 1) }), 'and ladderd holds the outputs at their safe values');
kill 'USR1', child($pid);
ok(until_true(sub { (slurp("$dir/out") // '') =~ /^state: STOP$/m }), 'it lives, in STOP');
{
	my $status = board('status');
	like($status, qr/^stop: ladderd has ended abnormally three times within a minute$/m, 'a desk is told why');
	like($status, qr/^before this start: began in STOP: ladderd had ended abnormally three times within a minute$/m, 'and how it began');
}
kill 'HUP', $pid;
sleep 0.05;
kill 'TERM', $pid;
is(finish($pid), 0, 'SIGTERM ends both');

# ---- orderly ends ----
fresh();
is(finish(start(named(), '--', @ladderd, '--scans', 3)), 0, 'an orderly end: the same status');
ok(is_at('ladderd', 0, 1), 'ladderd made the outputs safe itself');
unlike(err(), qr/ladder-guard:/, 'nothing is told');
is(finish(start(named(), '--', $ladderd, '--nonsense')), 2, 'status 2 of ladderd is that of the guard');
is(finish(start(named(), '--', "$dir/nothing")), 127, 'a program that is not there');
like(err(), qr/^ladder-guard: "\S+nothing" cannot be started$/m, 'is told');

# ---- a line that another process holds ----
mkdir "$dir/slots";
fresh();
$pid = start(named(), '--', @ladderd, @linked, '--slots', "$dir/slots");
until_true(\&runs);
{
	# The child locks OUT0 as soon as ladderd is dead: it waits for the lock of the kernel.
	my $holder = fork // die;
	if (!$holder) {
		open my $file, '+<', "$dir/lines" or POSIX::_exit(1);
		my $lock = pack 's s x4 q q i x4', POSIX::F_WRLCK(), SEEK_SET, 2, 1, 0;
		fcntl $file, POSIX::F_SETLKW(), $lock or POSIX::_exit(1);
		sleep 1 while getppid() != 1;
		POSIX::_exit(0);
	}
	sleep 0.1;
	kill 'STOP', $pid;
	kill 'KILL', child($pid);
	sleep 0.1;
	kill 'CONT', $pid;
	ok(until_true(sub { err() =~ /line 2 of gpiochip0 is held by "[^"]*": it is not safe; the guard tries again/ }),
		'a line that another process holds is told');
	ok(until_true(sub { (lines())[1][0] == 1 }), 'the other output is safe');
	# Also after more starts than make it begin in STOP: none of them has driven an output.
	ok(until_true(sub { err() =~ /(?:ended with status 1.*){3}/s }), 'ladderd is started again and again');
	kill 'KILL', $holder;
	waitpid $holder, 0;
	ok(until_true(\&runs), 'when it is free, ladderd runs again');
	like(events('33'), qr/^33 1 [4-9]$/, 'that it had ended with a status is an event');
	like(board('status'), qr/^before this start: ladderd ended with status 1; ladder-guard made the outputs safe and started it again; since the guard began: [4-9] times$/m,
		'and told in the status');
	kill 'TERM', $pid;
	finish($pid);
}

# ---- a scan that hangs in a driver ----
# Nothing but SIGKILL interrupts the first two, so ladderd itself can do nothing; how long a heartbeat
# lasts does not matter to the guard. The third one lets signals through: ladderd makes the outputs safe
# itself, and lives to tell it.
{
	my $hang_map = spew("$dir/hang.io", "BOARD \"panel\"\n%IX0.0 gpio line=IN0\n%QX0.0 gpio line=OUT0 safe=0\n%QX0.1 gpio line=OUT1 safe=1\n");
	my @hung = ($ladderd, $rung, '--io', $hang_map, '--period', '10ms', '--watchdog', 10);
	my @took;
	for my $case (([]) x ($ENV{GUARD_HANGS} || 1), ['--heartbeat', 10000]) {
		fresh();
		unlink glob "$dir/slots/*";
		$pid = start(named(), @$case, '--', @hung, @linked, '--slots', "$dir/slots");
		until_true(\&runs);
		my $since = clock_gettime(CLOCK_MONOTONIC);
		reads(3);
		my $at = guarded_since($since);
		my $with = @$case ? "heartbeat $$case[1] ms" : 'heartbeat as it is by default';
		ok(defined $at, "a driver hangs, $with: the guard makes the outputs safe");
		push @took, 1e3 * ($at - waits_since()) - 100 if defined $at;
		like(err(), qr/ladderd hung in a scan and is killed; the outputs are safe/, 'since the scan is over its limit, not the heartbeat');
		reads(0);
		ok(until_true(\&runs), 'when the driver answers, ladderd runs again');
		is(events('34'), '34 1', 'with an event');
		kill 'TERM', $pid;
		finish($pid);
	}
	diag(sprintf 'a driver hangs: %d times safe after the limit of the scan: p50 %.1f ms, max %.1f ms', scalar @took,
		median(@took), (sort { $b <=> $a } @took)[0]) if @took;
	fresh();
	$pid = start(named(), '--heartbeat', 10000, '--', @hung);
	until_true(\&runs);
	reads(2);
	ok(until_true(sub { is_at('ladderd', 0, 1) }), 'a signal reaches the driver: ladderd makes the outputs safe');
	my ($at) = sort { $b <=> $a } map { $_->[2] } (lines())[0, 1];
	diag(sprintf 'a signal reaches the driver: safe %.1f ms after the limit of the scan', 1e3 * ($at - waits_since()) - 100);
	sleep 0.1; # more than the grace of the guard
	reads(0);
	ok(until_true(sub { err() =~ /FAULT, outputs are safe: watchdog/ }), 'and it lives: its fault is told');
	unlike(err(), qr/killed/, 'the guard has left it alone');
	kill 'TERM', $pid;
	finish($pid);
}

# ---- a download, a restart, another map ----
# The other program drives OUT0 the other way round, with the other safe value; OUT1 goes, OUT2 and OUT3
# come. In RUN each output has the level that is not its safe one. An open drain needs a restart.
{
	my @wired = ("%QX0.0 gpio line=OUT0 safe=1\n", "%QX0.2 gpio line=OUT2 safe=1\n%QX0.3 gpio line=OUT3 safe=0\n");
	my %other_map = (swap => spew("$dir/other.io", "BOARD \"panel\"\n@wired"),
		restart => spew("$dir/drain.io", "BOARD \"panel\"\n" . $wired[0] =~ s/safe/open-drain safe/r . $wired[1]));
	my $other = spew("$dir/other.rung", slurp($rung) =~ s/Brake AT %QX0\.1 : BOOL;/Old AT %QX0.2 : BOOL;\n  New AT %QX0.3 : BOOL;/r
		=~ s/NO SYS_ALWAYS_ON \| COIL Motor/NC SYS_ALWAYS_ON | COIL Motor/r =~ s/COIL Brake \|/COIL Old |\nRUNG\n  | NO SYS_ALWAYS_ON | COIL New |/r);
	my @before = (@ladderd, @linked, '--slots', "$dir/slots", '--period', '5ms');
	my $sent;
	sub outputs { return join ' ', map { $_->[0] } lines() }
	my $begin = sub {
		fresh();
		unlink glob "$dir/slots/*";
		my $guard_pid = start(named(), '--', @before);
		until_true(sub { runs() && -S "$dir/link" });
		return $guard_pid;
	};
	my $send = sub {
		my ($how) = @_;
		$sent = fork // die;
		return if $sent;
		open STDOUT, '>', "$dir/sent" or die;
		open STDERR, '>&', \*STDOUT or die;
		exec "$build/ladder", 'board', "unix:$dir/link", 'download', $other, $other_map{$how}, '--yes', $how eq 'swap' ? () : '--restart';
	};
	my $runs_other = sub { my @line = lines(); return $line[0][0] == 0 && $line[2][0] == 0 && $line[3][0] == 1 && $line[3][1] eq 'ladderd' };
	# Ends ladderd, and the guard before it starts another, or else in order: the safe levels stay. Which
	# map it knew: in the old one OUT0 is safe at 0. '': all lines are safe.
	my $end = sub {
		my ($guard_pid, $orderly) = @_;
		my $pid = child($guard_pid);
		kill 'STOP', $guard_pid;
		kill 'STOP', $pid;
		until_true(sub { is_state($pid, 'T') });
		my $ran = $runs_other->();
		kill 'KILL', $pid;
		until_true(sub { is_state($pid, 'Z') });
		kill 'TERM', $guard_pid;
		kill 'CONT', $guard_pid;
		my $status = finish($guard_pid);
		my @line = lines();
		my $knew = $line[0][4] ? 'new' : 'old';
		# A line that comes: if ladderd had it, the guard has it.
		my @come = $knew eq 'new' ? (2, 3) : grep { $line[$_][1] ne '' } 2, 3;
		my @want = ($knew eq 'old' ? 0 : 1, 1, 1, 0);
		my $bad = join ', ', map { $line[$_][0] == $want[$_] ? () : "OUT$_ is $line[$_][0]" } 0, 1, @come;
		$bad .= " not taken: OUT$_" for grep { !$line[$_][3] } 0, $knew eq 'old' ? 1 : (), @come;
		$bad .= " status $status" if $status ne 128 + 9 && !($orderly && $status eq 0);
		$bad .= ' the old map' if $knew eq 'old' && $ran;
		return ($knew, $bad);
	};
	my %took;
	for my $how (qw(swap restart)) {
		my $guard_pid = $begin->();
		my $since = clock_gettime(CLOCK_MONOTONIC);
		my $was = child($guard_pid);
		$send->($how);
		ok(until_true($runs_other), "$how: the other program drives the lines of its map");
		waitpid $sent, 0;
		$took{$how} = clock_gettime(CLOCK_MONOTONIC) - $since;
		is(child($guard_pid), $was, "$how: by the same ladderd");
		is_deeply([$end->($guard_pid)], ['new', ''], "$how: when ladderd is killed then, the guard knows the new lines and safe values");
	}
	# The table comes when the guard has read all packets, and before it asks whether ladderd has ended.
	{
		my $guard_pid = $begin->();
		poke(56 * $count + 8, pack 'q', 1);
		until_true(sub { is_state($guard_pid, 'T') });
		$send->('swap');
		ok(until_true($runs_other), 'while the guard does not listen');
		waitpid $sent, 0;
		is_deeply([$end->($guard_pid, 1)], ['new', ''], 'what a ladderd has said before its end counts');
	}
	my $swaps = $ENV{GUARD_SWAPS} || 12;
	my (%knew, @bad);
	for my $number (1 .. $swaps) {
		my $how = $number % 3 ? 'swap' : 'restart';
		my $guard_pid = $begin->();
		$send->($how);
		sleep rand 1.1 * $took{$how};
		my ($knew, $bad) = $end->($guard_pid);
		waitpid $sent, 0;
		$knew{$knew}++;
		$knew{"$knew, lines of both"}++ if $knew eq 'old' && (lines())[2][3];
		push @bad, "$how: $bad" if $bad;
	}
	is_deeply(\@bad, [], "$swaps kills around an exchange: each line of both maps is safe");
	diag(join ', ', map { "$_ map $knew{$_}" } sort keys %knew);
	# STOP, RUN and a reset leave lines and guard as they are.
	{
		my $guard_pid = $begin->();
		my $was = child($guard_pid);
		board('stop');
		ok(until_true(sub { is_at('ladderd', 0, 1) }), 'a desk stops the program: both are safe');
		board('run --cold');
		ok(until_true(\&runs), 'it runs again');
		is(child($guard_pid), $was, 'in the same ladderd');
		is_deeply([$end->($guard_pid)], ['old', ''], 'and the guard makes its lines safe as before');
	}
}

# ---- a kernel without pidfd: SIGCHLD ----
{
	local $ENV{FAKE_NO_PIDFD} = 1;
	fresh();
	$pid = start(named(), '--', @ladderd);
	until_true(\&runs);
	my $child = child($pid);
	my $since = clock_gettime(CLOCK_MONOTONIC);
	kill 'KILL', $child;
	my $at = guarded_since($since);
	ok(defined $at, 'without pidfd the outputs are safe, too');
	diag(sprintf 'without pidfd: safe after %.1f ms', 1e3 * ($at - $since)) if defined $at;
	until_true(\&runs);
	kill 'TERM', $pid;
	is(finish($pid), 0, 'and an orderly end is one');
}

# ---- more outputs than the guard holds ----
{
	local $count = 302;
	local $ENV{FAKE_LINES} = $count;
	my $many = spew("$dir/many.io", "BOARD \"panel\"\n" . join '', map { '%QX' . int($_ / 8) . '.' . $_ % 8 . " gpio line=OUT$_ safe=1\n" } 0 .. 299);
	fresh();
	$pid = start(named(), '--', $ladderd, $rung, '--io', $many, '--period', '50ms');
	until_true(sub { my @line = lines(); !grep { $_->[1] ne 'ladderd' } @line });
	like(err(), qr/^ladderd: ladder-guard holds 256 outputs; 44 are not made safe by it$/m, 'more outputs than the guard holds are told');
	until_true(sub { (lines())[2][0] == 0 });
	kill 'KILL', child($pid);
	ok(until_true(sub { scalar(grep { $_->[3] } lines()) == 256 }), '256 of them are made safe');
	ok(!(grep { $_->[3] && $_->[4] != 1 } lines()), 'at their safe levels');
	kill 'TERM', $pid;
	finish($pid);
}

# ---- a ladderd that lies ----
# A script stands for ladderd. It says what no ladderd says, then the truth, and is killed.
{
	my $liar = spew("$dir/liar.pl", <<'END');
use strict; use warnings; use Socket; use IO::Handle;
my ($fd, $ms, $stopped, $ends, $how) = split / /, $ENV{LADDER_GUARD};
open my $guard, '+<&=', $fd or die;
my $magic = 0x31475552;
sub head { my ($kind, $count, $within) = @_; return pack 'L S S L', $magic, $kind, $count // 0, $within // 0 }
sub line { return pack 'S S C C C C', @_ }
sub say_it { send $guard, $_[0], MSG_NOSIGNAL or die "send: $!" }
if ($ends) {
	say_it(head(1, 0, 1000));
	print "$stopped $ends $how\n"; STDOUT->flush;
	exit 0;
}
my $dev = pack 'a64', '/dev';
my $good = line(0, 2, 1, 0, 0, 0);
say_it($_) for 'x', pack('L', $magic), head(0), head(99), head(1, 0, 0), head(1, 0, 120001), head(1) . 'x', head(3) . 'x',
	head(2, 1) . $dev, head(2, 2) . $dev . $good, head(2, 1) . $dev . $good . 'x', head(2, 2) . $dev . $good . $good,
	head(2, 257) . $dev . $good x 257, head(2, 1) . pack('a64', 'dev') . $good, head(2, 1) . '/' x 64 . $good,
	head(2, 1) . $dev . line(0, 2, 2, 0, 0, 0), head(2, 1) . $dev . line(0, 2, 1, 4, 0, 0), head(2, 1) . $dev . line(0, 2, 1, 0, 4, 0),
	head(2, 1) . $dev . line(0, 2, 1, 0, 0, 3), head(4) . 'no end' x 20, head(4) . 'short', head(5) . "\xff" x 31, head(6, 1) . $dev,
	"\0" x 9000;
say_it(head(2, 1) . $dev . $good);
say_it(head(3));
sysread $guard, my $answer, 100;
say_it(head(6, 1) . $dev . line(0, 3, 1, 0, 0, 0)) for 1 .. 2;
say_it(head(6, 1) . $dev . line(0, 2, 0, 0, 0, 0)) if $ENV{LIAR_LESS} == 1;
say_it(head(6, 0) . $dev) if $ENV{LIAR_LESS} == 2;
print length($answer), "\n"; STDOUT->flush;
kill 'KILL', $$;
END
	for my $less (0, 1, 2) { # 1: one of the table instead; 2: none
		local $ENV{LIAR_LESS} = $less;
		fresh();
		$pid = start(named(), '--', 'perl', $liar);
		is(finish($pid), 0, 'packets that say nothing do no harm');
		is(scalar(() = err() =~ /ladderd sent \d+ bytes that say nothing; they are not used/g), 1, 'and are told once');
		my @line = lines();
		is($line[0][4], 1, 'the output of the table is safe');
		is($line[1][3] ? 1 : 0, $less ? 0 : 1, $less ? 'one that was not exchanged is left alone' : 'so is one that ladderd was about to request');
		is(slurp("$dir/out"), "44\n0 1 9\n", 'the next one is told why it is there');
	}
}

# ---- the event log of the board ----
{
	unlink glob "$dir/slots/*";
	fresh();
	$pid = start(named(), '--heartbeat', 100, '--', @ladderd, @linked, '--slots', "$dir/slots");
	for my $step (['KILL', '31 9 1'], ['STOP', '31 9 1, 32 2']) {
		my ($signal, $want) = @$step;
		until_true(\&runs);
		kill $signal, child($pid);
		until_true(sub { events('31|32') eq $want });
		is(events('31|32'), $want, "a start after $signal is an event");
	}
	until_true(\&runs);
	like(board('status'), qr/^before this start: ladderd gave no sign of life; ladder-guard ended it, made the outputs safe and started it again; since the guard began: 2 times$/m,
		'the status tells the last one');
	kill 'TERM', $pid;
	is(finish($pid), 0, 'it ends');
}

# ---- signals that come before ladderd listens ----
# Alone: as soon as it holds them, or else when it listens. Under a guard: as soon as the guard does.
{
	my $mask = sub {
		my ($pid, $name, $program) = @_;
		return 0 if (readlink("/proc/$pid/exe") // '') !~ /\Q$program\E$/;
		return (slurp("/proc/$pid/status") // '') =~ /^$name:\s*([0-9a-f]+)/m ? hex(substr $1, -4) & 1 << 14 : 0;
	};
	my ($held, $good, $all) = (0, 0, 200);
	for (1 .. $all) {
		fresh();
		my $alone = $guard;
		$guard = $ladderd;
		my $pid = start(@ladderd[1 .. $#ladderd]);
		$guard = $alone;
		my $early = 0;
		until_quick(sub { ($early = $mask->($pid, 'SigBlk', 'guarded_ladderd')) || $mask->($pid, 'SigCgt', 'guarded_ladderd') });
		$held++ if $early;
		kill $_, $pid for 'USR1', 'HUP', 'TERM';
		$good++ if finish($pid) eq '0' && (slurp("$dir/out") // '') =~ /^state: /m;
	}
	is($good, $all, "SIGUSR1, SIGHUP and SIGTERM at once: the status is printed, and ladderd ends in order, $all times");
	cmp_ok($held, '>', 0, "$held times they came before it listened");
	($good, $all) = (0, 50);
	for (1 .. $all) {
		fresh();
		my $pid = start(named(), '--', @ladderd);
		until_quick(sub { $mask->($pid, 'SigBlk', 'guarded_guard') });
		kill $_, $pid for 'USR1', 'HUP', 'TERM';
		$good++ if finish($pid) eq '0' && err() !~ /died/;
	}
	is($good, $all, "the same through the guard, $all times");
}

# While the dynamic loader still runs nothing can hold them; no line is taken then.
{
	fresh();
	my $alone = $guard;
	$guard = 'env';
	is(finish(start("FAKE_EARLY=15", @ladderd)), 'signal 15', 'a signal while it is loaded, alone: it ends, and no line was touched');
	$guard = $alone;
	ok(!(grep { $_->[1] ne '' } lines()), 'indeed none');
	is(finish(start(named(), '--', 'env', 'FAKE_EARLY=15', @ladderd)), 0, 'under the guard the signal waits: it ends in order');
	ok(is_at('ladderd', 0, 1), 'with safe outputs');
}

# ---- signals while ladderd waits for the answer of the guard ----
# It must not go on without the answer: an output that holds would begin at 0.
{
	my $holds = spew("$dir/holds.io", "BOARD \"panel\"\n%QX0.0 gpio line=OUT0 safe=hold\n%QX0.1 gpio line=OUT1 safe=1\n");
	fresh();
	$pid = start(named(), '--', 'env', 'FAKE_INTERRUPTED=3', $ladderd, $rung, '--io', $holds);
	until_true(\&runs);
	my ($was, $changes) = (child($pid), (lines())[0][5]);
	kill 'KILL', $was;
	ok(until_true(sub { (lines())[1][3] && runs() && child($pid) != $was }), 'interrupted while it asks for its lines: it begins');
	is((lines())[0][5], $changes, 'with the level that is held');
	kill 'TERM', $pid;
	finish($pid);
}

# ---- refused ----
{
	my @name = named();
	fresh();
	$pid = start(@name, '--', @ladderd);
	until_true(\&runs);
	is(system("$guard @name -- $ladderd 2>$dir/second") >> 8, 1, 'a second guard is refused');
	like(slurp("$dir/second"), qr/^ladder-guard: another ladder-guard of this name runs; /, 'with a reason');
	ok(runs(), 'the first one goes on');
	kill 'TERM', $pid;
	is(finish($pid), 0, 'and ends as ever');
}
{
	local @ENV{map { "MANY_$_" } 1 .. 255} = (1) x 255;
	is(finish(start(named(), '--', @ladderd)), 1, 'too many variables');
	like(err(), qr/^ladder-guard: more than 254 variables in the environment; start it with fewer, for example with env -i or from systemd$/m,
	     'and what to do is told');
}
is(finish(start(named(), '--watchdog', $dir, '--', @ladderd)), 1, 'a watchdog that cannot be opened');
like(err(), qr/^ladder-guard: watchdog "\Q$dir\E": .*; name a watchdog device of this machine, or leave --watchdog out$/m, 'is told');
{
	my $device = spew("$dir/forbidden", '');
	chmod 0, $device;
	chmod 0711, $dir;
	chmod 0666, "$dir/lines";
	local $user = $> == 0 ? 65534 : $>;
	is(finish(start(named(), '--watchdog', $device, '--', @ladderd)), 1, 'a watchdog that its user may not write');
	like(err(), qr/^ladder-guard: watchdog "\Q$device\E": Permission denied; give the user of the service the right to write it, or leave --watchdog out$/m,
		'says what to do');
	unlink glob "$dir/out";
}
{
	local $ENV{FAKE_BUSY} = spew("$dir/busy", '');
	fresh();
	is(finish(start(named(), '--watchdog', "$dir/busy", '--', @ladderd)), 1, 'a watchdog that another program holds');
	like(err(), qr/^ladder-guard: watchdog "\S+busy": .* busy; another program feeds it: stop that, .*, or leave --watchdog out$/m, 'says so');
	ok(!(grep { $_->[1] ne '' } lines()), 'no line was touched');
}
is(finish(start(named(), '--heartbeat', $_, '--', @ladderd)), 2, "a heartbeat of $_ ms is out of range") for 5, 49, 10001, '50x';
for my $case ([2, qr/^-- and the command of ladderd are missing$/m], [2, qr/^-- names no program$/m, '--'],
		[2, qr/^--name is no option, or needs a value$/m, '--name'], [2, qr/^--fly is no option$/m, '--fly', 1, '--', @ladderd],
		[1, qr/^--name is too long$/m, '--name', 'x' x 200, '--', @ladderd]) {
	my ($status, $why, @args) = @$case;
	fresh();
	is(finish(start(@args)), $status, "refused: @args");
	like(err() =~ s/^ladder-guard: //r, $why, 'with the reason');
	ok(!(grep { $_->[1] ne '' } lines()), 'and no line was touched');
}
is(finish(start('--help')), 0, '--help');
like(slurp("$dir/out"), qr/^usage: ladder-guard .*\n  --heartbeat MS .*\n127 /s, 'tells the options and statuses');
for my $socket ('notify', '/' . 'x' x 200) {
	local $ENV{NOTIFY_SOCKET} = $socket;
	is(finish(start(named(), '--', @ladderd)), 1, 'a socket of the service manager that is none');
	is(err(), "ladder-guard: NOTIFY_SOCKET: no path of a socket\n", 'is told');
}

# ---- a ladderd that dies at once each time ----
# The guard waits a second before it starts it again; SIGTERM ends it then, too.
{
	fresh();
	$pid = start(named(), '--', 'perl', '-e', 'kill 9, $$');
	ok(until_true(sub { err() =~ /(?:died of signal 9.*){3}/s }), 'a program that dies at once is started again');
	my $tries = () = err() =~ /died of signal 9/g;
	kill 'TERM', $pid;
	like(finish($pid), qr/^(?:1|137|143)$/, 'SIGTERM ends the guard while nothing runs');
	cmp_ok($tries, '<', 6, 'and it had not filled the machine');
}

# ---- watchdog device and service manager ----
{
	my $socket = IO::Socket::UNIX->new(Type => SOCK_DGRAM, Local => "$dir/notify") or die;
	local @ENV{qw(NOTIFY_SOCKET WATCHDOG_USEC)} = ("$dir/notify", 100000);
	spew("$dir/watchdog", '');
	fresh();
	$pid = start(named(), '--watchdog', "$dir/watchdog", '--', @ladderd);
	my ($text, %seen) = '';
	until_true(sub {
		$socket->recv($text, 200);
		$seen{$text}++;
		return $seen{'READY=1'} && ($seen{'WATCHDOG=1'} // 0) >= 3;
	});
	ok($seen{'READY=1'}, 'READY=1 of ladderd is passed on');
	ok($seen{'WATCHDOG=1'}, 'WATCHDOG=1 is sent');
	kill 'KILL', child($pid);
	until_true(sub { $socket->recv($text, 200); $text eq 'STATUS=ladderd has died, outputs are safe' });
	is($text, 'STATUS=ladderd has died, outputs are safe', 'a death is told to the service manager');
	until_true(\&runs);
	kill 'TERM', $pid;
	is(finish($pid), 0, 'it ends');
	like(slurp("$dir/watchdog"), qr/^\0{3,}V$/, 'the watchdog device was fed, and stopped at the end');
	# A socket of the service manager without a file.
	{
		my $name = "guard-t-$$";
		my $other = IO::Socket::UNIX->new(Type => SOCK_DGRAM, Local => "\0$name") or die;
		local $ENV{NOTIFY_SOCKET} = "\@$name";
		local $ENV{WATCHDOG_USEC} = 30_000_000;
		fresh();
		$pid = start(named(), '--', @ladderd);
		$text = '';
		until_true(sub { $other->recv($text, 200, MSG_DONTWAIT); $text eq 'READY=1' });
		is($text, 'READY=1', 'an abstract one is told, too');
		kill 'TERM', $pid;
		is(finish($pid), 0, 'it ends');
	}
	# A terminal stands for the device: it vanishes when its other end is closed. Then another one is there.
	open my $terminal, '+<', '/dev/ptmx' or die;
	my $number = pack 'i', 0;
	ioctl $terminal, 0x40045431, $number or die;
	ioctl $terminal, 0x80045430, $number or die;
	symlink '/dev/pts/' . unpack('i', $number), "$dir/dog" or die;
	fresh();
	$pid = start(named(), '--watchdog', "$dir/dog", '--', @ladderd);
	until_true(\&runs);
	is(sysread($terminal, $text, 1), 1, 'a watchdog device is fed');
	my $was = child($pid);
	close $terminal;
	ok(until_true(sub { err() =~ /^ladder-guard: watchdog "\S+dog" takes no byte: [^;]*; if it still counts, it restarts the machine; the guard tries again$/m }),
		'it vanishes: that is told');
	until_true(sub { $socket->recv($text, 200); $text eq 'WATCHDOG=1' }) for 1 .. 5;
	spew("$dir/dog2", '');
	symlink "$dir/dog2", "$dir/next" or die;
	rename "$dir/next", "$dir/dog" or die;
	ok(until_true(sub { err() =~ /^ladder-guard: watchdog "\S+dog" is fed again$/m && length slurp("$dir/dog2") }), 'it is there again: it is fed');
	is(scalar(() = err() =~ /^ladder-guard:/mg), 2, 'each is told once');
	ok(runs() && child($pid) == $was, 'and the machine has run on');
	kill 'TERM', $pid;
	is(finish($pid), 0, 'it ends');
}
done_testing;
