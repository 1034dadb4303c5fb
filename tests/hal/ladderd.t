#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# ladderd.t - tests the runtime from outside: arguments, files, signals, status, and that
# outputs have their safe values after each way out of RUN. It uses the driver sim, or fake
# chips where a line must fail. It checks order and values, never times.
use strict;
use warnings;
use Test::More;
use File::Temp qw(tempdir);
use FindBin;
use IO::Socket::UNIX;
use Socket qw(MSG_DONTWAIT);
use POSIX ();
use Time::HiRes qw(sleep time);
use lib "$FindBin::Bin/..";
use Files;
use Limit;

my $build = $ENV{BUILD} || 'build';
my $ladderd = "$build/ladderd";
my $dir = tempdir(CLEANUP => 1);
@Limit::show = ("$dir/err", "$dir/out");
# Other tests run beside this one, which needs scans of milliseconds: root is served before them.
eval { setpriority 0, 0, -10 };
delete @ENV{qw(NOTIFY_SOCKET WATCHDOG_USEC WATCHDOG_PID)};

sub put { return spew("$dir/$_[0]", $_[1]) }
sub get { return slurp("$dir/$_[0]") // '' }

# Starts a daemon; its output goes to the files out and err.
sub start {
	my ($program, @args) = @_;
	unlink "$dir/out", "$dir/err";
	my $pid = fork;
	die "fork: $!" unless defined $pid;
	if (!$pid) {
		open STDOUT, '>', "$dir/out" or die;
		open STDERR, '>', "$dir/err" or die;
		open STDIN, '<', '/dev/null' or die;
		exec $program, @args;
		die "exec: $!";
	}
	return $pid;
}

# The same with a pipe as standard input; returns the pid and the write end.
sub start_attended {
	my ($program, @args) = @_;
	unlink "$dir/out", "$dir/err";
	pipe my $in, my $ours or die "pipe: $!";
	my $pid = fork;
	die "fork: $!" unless defined $pid;
	if (!$pid) {
		open STDOUT, '>', "$dir/out" or die;
		open STDERR, '>', "$dir/err" or die;
		open STDIN, '<&', $in or die;
		close $ours;
		exec $program, '--attended', @args;
		die "exec: $!";
	}
	close $in;
	return ($pid, $ours);
}

# Waits until a file matches.
sub until_has { my ($name, $want) = @_; return until_true(sub { get($name) =~ $want }) }

sub run { return finish(start(@_)); }

# The last values of outputs in the trace: "%QX0.0 1".
sub levels {
	my %level = @_;
	for (split /\n/, get('err')) {
		$level{$1} = $2 if /^%Q(X\S+) ([01])$/;
	}
	return \%level;
}

my $rung = put('seal.rung', <<'END');
RUNGBOARD 1
PROJECT "Seal"

VAR
  Start AT %IX0.0 : BOOL;
  Motor AT %QX0.0 : BOOL;
  Brake AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO Start | ---       | COIL Motor |
  | NO Motor^|
RUNG
  | NC Start | ---       | COIL Brake |
END_PROGRAM
END
my $loop = put('loop.rung', <<'END');
RUNGBOARD 1
PROJECT "Loop"

VAR
  Motor AT %QX0.0 : BOOL;
  Brake AT %QX0.1 : BOOL;
  Slow : TON;
END_VAR

PROGRAM Main LD
RUNG
  | NO SYS_ALWAYS_ON | COIL Motor |
RUNG
  | NO SYS_ALWAYS_ON | R Brake |
RUNG
  | NO SYS_ALWAYS_ON | TON Slow PT:=T#100ms | --- | JMP Again |
RUNG Done
  | NO SYS_ALWAYS_ON | RET |
RUNG Again
  | NO Motor | NC Brake | COIL Motor |
RUNG
  | NO SYS_ALWAYS_ON | JMP Again |
END_PROGRAM
END
my $map = put('sim.io', <<'END');
BOARD "on a table"
%IX0.0 sim pull-up
%QX0.0 sim safe=0
%QX0.1 sim safe=1
END
my $gpio = put('gpio.io', <<'END');
BOARD "fake panel"
%IX0.0 gpio line=IN0
%QX0.0 gpio line=OUT0
%QX0.1 gpio line=OUT1 safe=1
END

# Motor is switched on in the scan that never ends.
my $once = put('once.rung', <<'END');
RUNGBOARD 1
PROJECT "Once"

VAR
  Motor AT %QX0.0 : BOOL;
  Brake AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO SYS_ALWAYS_ON | --- | COIL Motor |
  |                 ^| NO Brake | COIL Brake |
RUNG Again
  | NO SYS_ALWAYS_ON | JMP Again |
END_PROGRAM
END
my $told = put('told.rung', <<'END');
RUNGBOARD 1
PROJECT "Told"

VAR
  Motor AT %QX0.0 : BOOL;
  Brake AT %QX0.1 : BOOL;
END_VAR

PROGRAM Main LD
RUNG
  | NO SYS_IO_FAULT | S Motor |
RUNG
  | NO SYS_ALWAYS_ON | COIL Brake |
END_PROGRAM
END

sub is_safe {
	my ($what) = @_;
	my $level = levels();
	is_deeply($level, { 'X0.0' => 0, 'X0.1' => 1 }, "$what: safe values");
}
my @traced = ('--trace-io', '--watchdog', '200');

# ---- arguments and files ----
is(run($ladderd, '--help'), 0, '--help');
like(get('out'), qr/^Usage: ladderd FILE --io MAP.*Example: /s, 'prints the help text');
is(run($ladderd, '--version'), 0, '--version');
like(get('out'), qr/^ladderd \d+\.\d+\.\d+, takes rung files and code images, gpio through libgpiod: \S+\n$/,
	'prints the help text');
for (['no arguments'], ['no map', $rung], ['no file', '--io', $map],
     ['two files', $rung, $rung, '--io', $map],
     ['unknown option', $rung, '--io', $map, '--fast'],
     ['no value', $rung, '--io', $map, '--period'],
     ['period without a unit', $rung, '--io', $map, '--period', '10'],
     ['period too short', $rung, '--io', $map, '--period=99us'],
     ['period too long', $rung, '--io', $map, '--period=61s'],
     ['watchdog 0', $rung, '--io', $map, '--watchdog', '0'],
     ['priority 50', $rung, '--io', $map, '--rt', '50'],
     ['scans 0', $rung, '--io', $map, '--scans', '0'],
     ['scans too large', $rung, '--io', $map, '--scans', '9' x 30],
     ['value of a flag', $rung, '--io', $map, '--check=1']) {
	my ($what, @args) = @$_;
	is(run($ladderd, @args), 2, "wrong usage: $what");
	like(get('err'), qr/^ladderd: .*--help/s, 'says so');
}
for (['no such program', "$dir/none.rung", $map, 2, qr/none\.rung/],
     ['no such map', $rung, "$dir/none.io", 2, qr/none\.io/],
     ['a folder', $dir, $map, 2, qr/\S/],
     ['empty program', put('e.rung', ''), $map, 1, qr/e\.rung.*LD101/],
     ['binary program', put('b.rung', "\0\1\2" x 99), $map, 1, qr/b\.rung/],
     ['empty map', $rung, put('e.io', ''), 1, qr/e\.io.*LD101/],
     ['bad map', $rung, put('b.io', "BOARD \"x\"\n%QX0.0 sim fast\n"), 1,
      qr/b\.io:2:12: error LD504: "fast" is not a known option/],
     ['bad program', put('n.rung', "RUNGBOARD 1\nPROJECT \"x\"\n\nPROGRAM M ".
      "LD\nRUNG\n  | NO Nope | COIL Nope2 |\nEND_PROGRAM\n"), $map, 1,
      qr/n\.rung.*LD301/]) {
	my ($what, $file, $io, $status, $text) = @$_;
	is(run($ladderd, $file, '--io', $io, @traced), $status, $what);
	like(get('err'), $text, "$what: says where");
	unlike(get('err'), qr/^%Q/m, "$what: no pin is touched");
	is(get('out'), '', "$what: nothing on stdout");
}
# ---- --rt keeps the processor from idle states that are slow to leave ----
my $latency = '/dev/cpu_dma_latency';
sub has_latency { return grep { (readlink $_ // '') eq $latency } glob "/proc/$_[0]/fd/*" }
for (['with --rt it is held, or what refused it is told', 1, '--rt', 1],
     ['with --no-pm-qos it is left alone', 0, '--rt', 1, '--no-pm-qos'],
     ['without --rt it is left alone', 0], ['with --rt 0 it is left alone', 0, '--rt', 0]) {
	my ($what, $wanted, @rt) = @$_;
	my $pid = start($ladderd, $rung, '--io', $map, @traced, @rt);
	until_has('err', qr/^%Q/m);
	my $held = has_latency($pid);
	my $told = get('err') =~ m{^ladderd: \Q$latency\E: \w.*; scans may begin later$}m;
	is($held + $told, $wanted, "$latency: $what");
	kill 'TERM', $pid;
	is(finish($pid), 0, 'ends');
}
# Errors and other warnings are those of `ladder check`; advice is printed only at the desk.
my $near = put('near.rung', "RUNGBOARD 1\n\nVAR_GLOBAL\n  Valve : BOOL;\nEND_VAR\n\n".
	       "PROGRAM M LD\nRUNG\n  | NO Valv | COIL Valve |\nEND_PROGRAM\n");
for (['LD301 names its word', $near, 1, qr/rung 1 \(1,1\): error LD301: "Valv"/, qr/did you mean/],
     ['a chart is checked', 'tests/golden/diag-LD451-dead-end/main.rung', 0, qr/warning LD439: /,
      qr/warning LD451: /]) {
	my ($what, $file, $status, $told, $advice) = @$_;
	is(run($ladderd, $file, '--io', $map, '--check'), $status, $what);
	like(get('err'), $told, 'says so');
	unlike(get('err'), $advice, 'and no more than that');
	my $desk = `$build/ladder check $file 2>&1`;
	like($desk, $_, "$what: ladder check says it") for $told, $advice;
}
my $half = put('half.io', "BOARD \"x\"\n%IX0.0 sim\n%QX0.0 sim\n");
is(run($ladderd, $rung, '--io', $half, '--scans', '1'), 0, 'a map without a line for an output');
like(get('err'), qr/half\.io.*warning LD515.*Brake/, 'is a warning');
my $bare = put('bare.rung', "RUNGBOARD 1\n\nPROGRAM M LD\nRUNG\n".
	       "  | NO I0 | NO %IX5.0 | COIL %QX7.0 |\nEND_PROGRAM\n");
is(run($ladderd, $bare, '--io', $half, '--scans', '1'), 0, 'addresses without names and lines');
like(get('err'), qr/LD515: "%IX5\.0".*\n.*LD515: "%QX7\.0".*\n/,
     'those without a line are told');
unlike(get('err'), qr/%IX0\.0/, 'addresses with a line give no warning');

sub sized {
	my ($name, %bytes) = @_;
	return put($name, join '', "RUNGBOARD 1\n\nCONFIGURATION C\n",
		   (map "  AREA $_ $bytes{$_};\n", sort keys %bytes),
		   "END_CONFIGURATION\n\nPROGRAM M LD\nRUNG\n",
		   "  | NO I0 | COIL Q0 |\nEND_PROGRAM\n");
}
my $large = sized('large.rung', V => 65536, Q => 1);
my $wide = put('wide.io', "BOARD \"x\"\n%IX0.0 sim\n%QX0.0 sim\n%QX1.0 sim\n");
is(run($ladderd, $large, '--io', $wide, @traced), 1, 'a line beyond its area');
like(get('err'), qr/wide\.io:4:1: error LD523: "%QX1\.0" /m, 'is an error with its place');
unlike(get('err'), qr/^%Q/m, 'no pin is touched');
is(run($ladderd, $large, '--io', $half, '--check'), 0, 'larger areas');
like(get('out'), qr/^data: 770\d\d bytes$/m, 'take more memory');
my $small = sized('small.rung', I => 1, Q => 1,
		  map {$_ => 0} qw(M V S AI AQ XI XQ XAI XAQ));
is(run($ladderd, $small, '--io', $half, '--check'), 0, 'smaller ones');
like(get('out'), qr/^data: 9\d bytes$/m, 'take less');
is(run($ladderd, $small, '--io', $half, '--scans', 2), 0, 'and that runs');

is(run($ladderd, $rung, '--io', $map, '--check', @traced), 0, '--check');
like(get('out'), qr/^code: \d+ bytes\ndata: \d+ bytes\nhal: at most \d+ /,
	'prints the memory needed');
is(get('err'), '', 'and does nothing');
is(run($ladderd, $rung, '--io', $gpio, '--check'),
	`$ladderd --version` =~ /none/ ? 1 : 0, '--check opens no chip');

# The maps of docs/boards.md are good, and the page names each of them.
for my $board (sort glob 'ladders/boards/*.io') {
	is(run("$build/tests/hal/ladderd_v1", $rung, '--io', $board, '--check'),
		0, $board);
	my ($name) = $board =~ m{([^/]+)$};
	open my $doc, '<', 'docs/boards.md' or die;
	ok((grep { /\Q$name\E/ } <$doc>) > 0, "$name is described");
}

# ---- scans and the status block ----
is(run($ladderd, $rung, '--io', $map, '--period', '1ms', '--scans', '25',
	@traced), 0, '--scans');
my $status = get('out');
like($status, qr/^scans: 25$/m, 'the number of scans');
like($status, qr/^fault: none$/m, 'without a fault');
like($status, qr/^$_: /m, "status has $_")
	for qw(state errors forces scans period scan wake-up late io board);
my ($mean, $most, $middle) = $status =~ /^body: mean (\d+) ns, max (\d+) ns, p50 (\d+) ns$/m;
ok($mean && $mean <= $most && $middle <= $most, 'mean and maximum of the program alone');
like($status, qr/^program: [0-9a-f]{64}\n\n$/m, 'the SHA-256 of the program');
like(get('err'), qr/^%QX0\.0 1\n%QX0\.1 0\n/, 'outputs follow the program');
is_safe('after --scans');

# A code image behaves like its rung file.
SKIP: {
	skip 'ladder is not built here', 2 unless -x "$build/ladder";
	is(system("$build/ladder", 'build', $rung, '-o', "$dir/seal.rungc"), 0,
		'ladder build');
	is(run($ladderd, "$dir/seal.rungc", '--io', $map, '--scans', '3'), 0,
		'a code image');
}

# ---- tasks ----
{
	my $body = <<'END';
VAR
  Motor AT %QX0.0 : BOOL;
  Brake AT %QX0.1 : BOOL;
  Bell  AT %IX0.0 : BOOL;
  Fasts, Slows, Bells : DINT;
END_VAR

PROGRAM Quick IL
  LD    Fasts
  ADD   1
  ST    Fasts
  LD    SYS_YEAR
  GT    2025
  ST    Motor
  STN   Brake
END_PROGRAM

PROGRAM Slowly IL
  LD    Slows
  ADD   1
  ST    Slows
  LD    Fasts
  LT    3
  RETC
Again:
  LD    Slows
  ADD   1
  ST    Slows
  LT    LIMIT
  JMPC  Again
END_PROGRAM

PROGRAM Rings IL
  LD    Bells
  ADD   1
  ST    Bells
END_PROGRAM
END
	my $config = <<'END';
RUNGBOARD 1

CONFIGURATION Plant
  TASK Slow (INTERVAL := T#10ms, PRIORITY := 5 SLOW);
  TASK Fast (INTERVAL := T#2ms, PRIORITY := 1);
  TASK Ring (SINGLE := Bell, PRIORITY := 0);
  PROGRAM A WITH Fast : Quick;
  PROGRAM B WITH Slow : Slowly;
  PROGRAM C WITH Ring : Rings;
END_CONFIGURATION

END
	my $make = sub {
		my ($name, $limit, $slow) = @_;
		my $text = $config . $body;
		$text =~ s/LIMIT/$limit/;
		$text =~ s/ SLOW/$slow/;
		return put($name, $text);
	};
	my $calm = $make->('calm.rung', 3, '');
	is(run($ladderd, $calm, '--io', $map, '--scans', '21', @traced), 0,
		'tasks run');
	my $status = get('out');
	like($status, qr/^period: 2000\.0 us$/m,
		'every 2 ms: 2, 10, and the 10 of events');
	like($status, qr/^task Ring: on event, runs 1, overruns 0, last /m,
		'one event, the input that was on at first');
	like($status, qr/^task Fast: every 2000\.0 us, runs \d\d, overruns \d+, last .* us, max .* us, waited \S+ us, interrupted \d+$/m,
		'the fast one');
	like($status, qr/^task Slow: every 10000\.0 us, runs \d+, /m,
		'the slow one');
	like(get('err'), qr/^%QX0\.0 1$/m, 'SYS_YEAR is of this century');
	is(run($ladderd, $calm, '--io', $map, '--scans', '9', '--period', '1ms'),
		0, '--period');
	like(get('out'), qr/^period: 1000\.0 us$/m, 'the period divides the intervals of the tasks');

	my $slow = $make->('slow.rung', 100000, ', WATCHDOG := T#100us');
	is(run($ladderd, $slow, '--io', $map, '--scans', '99', @traced), 1,
		'a task beyond its WATCHDOG');
	like(get('err'), qr/^ladderd: FAULT, outputs are safe: task Slow: watchdog: /m,
		'is a FAULT that names it');
	is_safe('a task beyond its WATCHDOG');
	my $wild = $make->('wild.rung', 2000000000, '');
	is(run($ladderd, $wild, '--io', $map, '--scans', '99', '--watchdog',
		'1000', @traced), 1, 'an endless loop in a task');
	like(get('out'), qr/^fault: task Slow: instruction budget exceeded/m,
		'names it, too');
	is_safe('an endless loop in a task');
}

# ---- tasks that interrupt others: Slow waits for Fast ----
{
	my $wait = put('wait.rung', <<'END');
RUNGBOARD 1

CONFIGURATION Plant
  TASK Slow (INTERVAL := T#20ms, PRIORITY := 5);
  TASK Fast (INTERVAL := T#1ms, PRIORITY := 1);
  PROGRAM A WITH Fast : Quick;
  PROGRAM B WITH Slow : Waits;
END_CONFIGURATION

VAR_GLOBAL
  Runs    : DINT;
  Whole   AT %QX0.0 : BOOL;
  Started AT %QX0.1 : BOOL;
  Waited  AT %QX1.0 : BOOL;
END_VAR

PROGRAM Quick IL
  LD    Runs
  ADD   1
  ST    Runs
  LD    Started
  ST    Whole
END_PROGRAM

PROGRAM Waits IL
VAR
  Until : DINT;
END_VAR
  LD    SYS_FIRST_SCAN
  RETC
  LD    Runs
  ADD   3
  ST    Until
  LD    TRUE
  ST    Started
More:
  LD    Runs
  LT    Until
  JMPC  More
  LD    FALSE
  ST    Started
  LD    TRUE
  ST    Waited
END_PROGRAM
END
	my $lines = put('wait.io', "BOARD \"x\"\n%QX0.0 sim\n%QX0.1 sim\n%QX1.0 sim\n");
	is(run($ladderd, $wait, '--io', $lines, '--scans', '60', '--watchdog', '1000', '--trace-io'), 0,
		'a task that waits for one of higher priority goes on');
	like(get('err'), qr/^%QX1\.0 1$/m, 'its outputs are set when it has ended');
	unlike(get('err'), qr/^%QX0\.[01] 1$/m, 'nobody sees an output that it sets meanwhile');
	like(get('out'), qr/^task Slow: .*, waited \S+ us, interrupted ([3-9]|\d\d+)$/m, 'the status counts that');
	like(get('out'), qr/^task Fast: (?!.*interrupted)/m, 'the highest one is not interrupted');
}

# ---- stopped by signals ----
for my $signal (qw(TERM INT)) {
	my $pid = start($ladderd, $rung, '--io', $map, @traced);
	ok(until_has('err', qr/^%QX0\.1 0$/m), 'runs');
	kill 'USR1', $pid;
	ok(until_has('out', qr/\n\n/), 'SIGUSR1 gives a status');
	like(get('out'), qr/^state: RUN\n/, 'RUN');
	kill 'HUP', $pid;
	ok(until_has('err', qr/nothing to reset/), 'SIGHUP in RUN');
	kill 'ALRM', $pid; # sent by another process, not by the watchdog
	kill $signal, $pid;
	is(finish($pid), 0, "SIG$signal: exit 0");
	is_safe("SIG$signal");
	is(scalar(() = get('out') =~ /\n\n/g), 1, 'one status block');
}
{
	my $pid = start($ladderd, $rung, '--io', $map, @traced);
	until_has('err', qr/^%QX0\.1 0$/m);
	kill 'SEGV', $pid;
	like(finish($pid), qr/^(signal 11|1)$/, 'a crash is not hidden');
	is_safe('crash');
}

# ---- a fault in the program ----
{
	my $pid = start($ladderd, $loop, '--io', $map, @traced, '--period',
		'50ms', '--watchdog', '1000');
	ok(until_has('err', qr/FAULT/), 'an endless loop is a FAULT');
	like(get('err'), qr/^%QX0\.0 1\n.*^ladderd: FAULT, outputs are safe: .*Main rung 6/ms,
		'which names POU and rung');
	is_safe('fault in the program');
	kill 'USR1', $pid;
	ok(until_has('out', qr/\n\n/), 'status of a FAULT');
	like(get('out'), qr/^state: FAULT\nfault: .*Main rung 6/, 'has its place');
	kill 'HUP', $pid;
	ok(until_has('err', qr/reset, RUN/), 'SIGHUP resets it');
	ok(until_has('err', qr/reset, RUN.*FAULT/s), 'the FAULT comes again');
	kill 'TERM', $pid;
	is(finish($pid), 1, 'the exit status after a FAULT is 1');
	is_safe('after it');
	is(run($ladderd, $loop, '--io', $map, '--scans', '1000', @traced), 1,
		'--scans ends at a FAULT');
	is_safe('and');
	is(run($ladderd, $once, '--io', $map, '--scans', '1', @traced), 1,
		'a fault in the first scan');
	unlike(get('err'), qr/^%QX0\.0 1$/m,
		'what a scan wrote that did not end is never at a line');
}

# ---- the program executes STOP ----
{
	my $halt = put('halt.rung', <<'EOT');
RUNGBOARD 1

VAR
  Motor AT %QX0.0 : BOOL;
  Brake AT %QX0.1 : BOOL;
  Slow  : TON;
END_VAR

VAR RETAIN
  Starts : INT;
END_VAR

PROGRAM Main LD
RUNG
  | COIL Motor |
RUNG
  | R Brake |
RUNG
  | NO SYS_FIRST_SCAN | [ Starts := Starts + 1 ] |
RUNG "Enough"
  | TON Slow PT:=T#60ms | STOP |
END_PROGRAM
EOT
	my $pid = start($ladderd, $halt, '--io', $map, @traced);
	ok(until_has('err', qr/STOP/), 'a program executes STOP');
	like(get('err'), qr/^%QX0\.0 1\n.*^ladderd: STOP, outputs are safe: the program says so: Main rung 4$/ms,
		'is told with its place');
	is_safe('STOP');
	kill 'USR1', $pid;
	ok(until_has('out', qr/\n\n/), 'it stays alive: status of a STOP');
	like(get('out'), qr/^state: STOP\nfault: none\nstop: the program says so, Main rung 4/,
		'says why');
	kill 'HUP', $pid;
	ok(until_has('err', qr/reset, RUN/), 'SIGHUP starts it again');
	ok(until_has('err', qr/reset, RUN.*STOP/s), 'it stops again');
	kill 'TERM', $pid;
	is(finish($pid), 0, 'SIGTERM ends it: no fault');
	is(run($ladderd, $halt, '--io', $map, '--scans', '1000'), 0,
		'--scans ends at a STOP');
}

# ---- --attended: the program that started it has ended ----
{
	my ($pid, $pipe) = start_attended($ladderd, $rung, '--io', $map, @traced);
	ok(until_has('err', qr/^%QX0\.1 0$/m), '--attended: it runs');
	syswrite $pipe, "what is said to it\n" x 20;
	kill 'USR1', $pid;
	ok(until_has('out', qr/^state: RUN$/m), 'input is ignored');
	close $pipe;
	is(finish($pid), 0, 'it ends when its standard input does');
	is_safe('input ended');
	is(run($ladderd, $rung, '--io', $map, '--attended', @traced), 0,
		'at once if there is none');
	($pid, $pipe) = start_attended($ladderd, "$dir/halt.rung", '--io', $map, @traced);
	ok(until_has('err', qr/STOP/), '--attended: in a STOP of the program');
	close $pipe;
	is(finish($pid), 0, 'it ends, too');
}

# ---- loops of each kind, reported with their place ----
{
	my $out = "VAR\n  Motor AT %QX0.0 : BOOL;\n  Brake AT %QX0.1 : BOOL;\n" .
		"  I : LINT;\nEND_VAR\n";
	my %kinds = (
		'a list' => ['Main line 11', "PROGRAM Main IL\n  LD TRUE\n  ST Motor\n" .
			"Again:\n  JMP Again\nEND_PROGRAM\n"],
		'FOR' => ['Main rung 4', "PROGRAM Main LD\nRUNG\n  | COIL Motor |\nRUNG\n" .
			"  | FOR I := 1 TO 9000000000 |\nRUNG\n  | R Brake |\n" .
			"RUNG\n  | NEXT |\nEND_PROGRAM\n"],
		'a function block' => ['Endless rung 2', "VAR\n  Belt : Endless;\nEND_VAR\n" .
			"PROGRAM Main LD\nRUNG\n  | NO Motor | Endless Belt |\n" .
			"RUNG\n  | COIL Motor |\nEND_PROGRAM\n" .
			"FUNCTION_BLOCK Endless LD\nRUNG Top\n  | COIL Brake |\n" .
			"RUNG\n  | JMP Top |\nEND_FUNCTION_BLOCK\n"],
		'a function block in a list' => ['Endless line 18', "VAR\n  Belt : Endless;\n" .
			"END_VAR\nPROGRAM Main IL\n  LD Motor\n  CALC Belt\n" .
			"  LD TRUE\n  ST Motor\nEND_PROGRAM\n" .
			"FUNCTION_BLOCK Endless IL\nTop:\n  JMP Top\nEND_FUNCTION_BLOCK\n"],
		'a subroutine' => ['Spin rung 1', "PROGRAM Main LD\nRUNG\n" .
			"  | NO Motor | CALL Spin |\nRUNG\n  | COIL Motor |\nEND_PROGRAM\n" .
			"SUBROUTINE Spin LD\nRUNG Top\n  | JMP Top |\nEND_SUBROUTINE\n"],
	);
	for my $kind (sort keys %kinds) {
		my ($place, $text) = @{$kinds{$kind}};
		my $file = put('endless.rung', "RUNGBOARD 1\n$out$text");
		is(run($ladderd, $file, '--io', $map, '--scans', '100', '--trace-io',
			'--watchdog', '1000'), 1, "$kind without an end is a FAULT");
		like(get('err'), qr/^ladderd: FAULT, outputs are safe: instruction budget.*$place/m,
			"told at $place");
		unlike(get('err'), qr/^%QX0\.0 1$(?!.*^%QX0\.0 0$)/ms,
			"$kind: safe values");
	}
}

# ---- a failed operation is no fault; it is reported once with its place ----
{
	my $file = put('divides.rung', "RUNGBOARD 1\nVAR\n  Motor AT %QX0.0 : BOOL;\n" .
		"  Parts : INT := 12;\n  Minutes : INT;\nEND_VAR\nPROGRAM Main LD\n" .
		"RUNG\n  | COIL Motor |\n" .
		"RUNG\n  | NO Motor | [ Parts := Parts / Minutes ] |\nEND_PROGRAM\n");
	is(run($ladderd, $file, '--io', $map, '--scans', '20', '--trace-io'), 0,
		'a division by zero is no fault');
	my @told = get('err') =~ /^ladderd: an operation failed, ENO is FALSE, Main rung 2 \(1,\d+\)$/mg;
	is(@told, 1, 'the failed operation is reported once, with rung and cell');
	like(get('err'), qr/^%QX0\.0 1$/m, 'the other rungs go on');
}

# ---- a trace has values of words, and says which are not good ----
{
	my $file = put('words.rung', "RUNGBOARD 1\nVAR\n  Level AT %AIW0 : INT;\n  Twice AT %AQW0 : INT;\n  Share AT %QD8 : REAL;\n" .
		"  Count : INT;\nEND_VAR\nPROGRAM Main ST\n  Count := Count + 1;\n  IF Count < 4 THEN\n    Twice := Level * 2 + Count;\n" .
		"  END_IF;\n  Share := 0.5;\nEND_PROGRAM\n");
	my $io = put('words.io', "BOARD \"b\"\nBUS m modbus-tcp host=127.0.0.1:9\n%AIW0 modbus bus=m unit=1 input-register=0 substitute=70\n" .
		"%AQW0 sim\n%QD8 modbus bus=m unit=1 holding-register=4 as=REAL safe=0\n");
	is(run($ladderd, $file, '--io', $io, '--scans', '20', '--trace-io'), 0, 'a map with words runs');
	is(join(' ', get('err') =~ /^(%.*)$/mg), '%AIW0 70 stale %AQW0 141 %QD8 0.5 stale %AQW0 142 %AQW0 143',
		'each change of an output and of a quality, once');
}

# ---- lines that fail, scans that hang, on every gpio driver ----
for my $version (qw(v1 v2 uapi)) {
	my $fake = "$build/tests/hal/ladderd_$version";
	local $ENV{FAKE_DEV} = "$dir/dev";
	mkdir "$dir/dev";
	put('dev/gpiochip0', '');
	is(run($fake, $rung, '--io', $gpio, '--scans', '20', @traced), 0,
		"$version: runs");
	is_safe("$version");
	{
		local $ENV{FAKE_FAIL_AT} = 10;
		local $ENV{FAKE_HEAL_AT} = 14;
		my $pid = start($fake, $rung, '--io', $gpio, @traced);
		ok(until_has('err', qr/FAULT/), "$version: a lost line");
		is_safe("$version: I/O fault");
		kill 'HUP', $pid;
		ok(until_has('err', qr/a line does not answer|reset/),
			'reset while it is lost');
		for (1 .. 20) {
			last if get('err') =~ /reset, RUN/;
			kill 'HUP', $pid;
			sleep 0.1;
		}
		like(get('err'), qr/reset, RUN\n(.*\n)*%QX0\.0 1$/m,
			'reset when it is back');
		kill 'USR1', $pid;
		until_has('out', qr/\n\n/);
		like(get('out'), qr/^resets: 1\nio: good.* 1 reopened$/m,
			'status knows');
		kill 'TERM', $pid;
		is(finish($pid), 0, 'exit 0 after a reset');
	}
	{
		local $ENV{FAKE_HANG_AT} = 10;
		my $pid = start($fake, $rung, '--io', $gpio, '--trace-io',
			'--watchdog', '20');
		ok(until_has('err', qr/^%QX0\.1 1$/m),
			"$version: the watchdog acts though the scan hangs");
		is_safe("$version: watchdog");
		kill 'TERM', $pid;
		is(finish($pid), 1, 'it can be ended');
		is_safe('then');
		($pid, my $pipe) = start_attended($fake, $rung, '--io', $gpio,
			'--trace-io', '--watchdog', '20');
		ok(until_has('err', qr/^%QX0\.1 1$/m), "$version: --attended, a scan hangs");
		close $pipe;
		is(finish($pid), 1, 'it ends when its standard input is closed');
		is_safe('then');
	}
	{
		local $ENV{FAKE_SLOW_AT} = 5;
		is(run($fake, $rung, '--io', $gpio, '--scans', '20', @traced), 0,
			"$version: late scans are no FAULT");
		get('out') =~ /^late: (\d+)$/m;
		ok($1 >= 15, 'but each is counted');
		is(run($fake, $rung, '--io', $gpio, '--trace-io', '--scans', '500',
			'--watchdog', '3'), 1, 'three in a row are one');
		like(get('out'), qr/^state: FAULT\nfault: .*watchdog/,
			'which says so');
		my ($scans) = get('out') =~ /^scans: (\d+)/m;
		ok($scans <= 6, 'at the third') or diag("scans: $scans");
		is_safe('late');
	}
	{
		local $ENV{FAKE_SLOW_AT} = 1;
		local $ENV{FAKE_SLOW_MS} = 250;
		local $ENV{FAKE_SLOW_EACH} = 2;
		is(run($fake, $rung, '--io', $gpio, '--scans', '8', '--period',
			'200ms', '--watchdog', '4'), 0,
			"$version: late scans that are not in a row");
		get('out') =~ /^late: (\d+)$/m;
		ok($1 >= 3, 'three late scans and more are counted') or diag(get('out'));
	}
	{
		local $ENV{FAKE_FAIL_AT} = 5;
		local $ENV{FAKE_HEAL_AT} = 6;
		is(run($fake, $told, '--io', $gpio, '--scans', '20', @traced), 0,
			"$version: a read that fails once is no FAULT");
		like(get('err'), qr/^%QX0\.0 1$/m, 'SYS_WD_LATE is TRUE');
	}
	{
		# Only the first write works; all others fail.
		local $ENV{FAKE_DEAF_AT} = 2;
		my $pid = start($fake, $loop, '--io', $gpio, @traced, '--period',
			'50ms', '--watchdog', '1000');
		ok(until_has('err', qr/FAULT/), "$version: deaf outputs");
		kill 'HUP', $pid;
		ok(until_has('err', qr/a line does not answer|reset, RUN/),
			'an answer to the reset');
		unlike(get('err'), qr/reset, RUN/, 'no reset without safe outputs');
		kill 'KILL', $pid;
		finish($pid);
	}
	{
		local $ENV{FAKE_DEAF_AT} = 2;
		local $ENV{FAKE_HEAR_AT} = 4;
		my $pid = start($fake, $loop, '--io', $gpio, @traced, '--period',
			'50ms', '--watchdog', '1000');
		ok(until_has('err', qr/FAULT(.*\n)*%QX0\.0 0$/m),
			"$version: safe values are tried until they arrive");
		is_safe('then');
		kill 'TERM', $pid;
		finish($pid);
	}
	{
		local $ENV{FAKE_CRASH_AT} = 10;
		like(run($fake, $rung, '--io', $gpio, @traced),
			qr/^(signal 11|1)$/, "$version: a crash in a scan");
		is_safe("$version: crash");
	}
	my $wrong = put('wrong.io', "BOARD \"x\"\n%QX0.0 gpio line=OUT9\n");
	is(run($fake, $rung, '--io', $wrong, @traced), 1, 'no such line');
	like(get('err'), qr/wrong\.io:2:1: error LD508.*OUT9/, 'is named');
}

# ---- a service manager ----
for my $name ("$dir/notify", "\0ladderd-test-$$") {
	my $socket = IO::Socket::UNIX->new(Type => SOCK_DGRAM, Local => $name);
	SKIP: {
		skip "no such socket here: $!", 2 unless $socket;
		local $ENV{NOTIFY_SOCKET} = $name =~ /^\0(.*)/ ? "\@$1" : $name;
		local $ENV{WATCHDOG_USEC} = 100000;
		is(run($ladderd, $rung, '--io', $map, '--scans', '30'), 0,
			'with NOTIFY_SOCKET');
		my @said;
		$socket->blocking(0);
		while (defined $socket->recv(my $text, 200)) {
			last if $text eq '';
			push @said, $text;
		}
		like(join(' ', @said),
			qr/^(WATCHDOG=1 )?READY=1 (WATCHDOG=1 )+STOPPING=1$/,
			'READY, WATCHDOG, STOPPING');
	}
}

# ---- what a service manager hears when something hangs: only a scan that hangs ends its patience ----
{
	my $fake = "$build/tests/hal/ladderd_uapi";
	my $socket = IO::Socket::UNIX->new(Type => SOCK_DGRAM, Local => "$dir/patience") or die "socket: $!";
	local @ENV{qw(FAKE_DEV NOTIFY_SOCKET WATCHDOG_USEC FAKE_SYNC_HANGS)} =
		("$dir/dev", "$dir/patience", 100000, "$dir/hang");
	put('group', "ladder-eng:x:" . (split ' ', $))[0] . ":\n");
	mkdir "$dir/slots";
	my $kept = put('kept.rung', <<'END');
RUNGBOARD 1

VAR RETAIN
  Count : DINT;
END_VAR

PROGRAM Main LD
RUNG
  | ADD IN1:=Count IN2:=1 OUT=>Count |
END_PROGRAM
END
	my @linked = ('--link', "$dir/link", '--groups', "$dir/group");
	my $board = sub { return scalar `$build/ladder board unix:$dir/link @_ 2>&1` };
	my $drain = sub { my $text; 1 while defined $socket->recv($text, 200, MSG_DONTWAIT) };
	my $fed = sub { my $text = ''; $drain->(); $socket->recv($text, 200) while $text ne 'WATCHDOG=1'; return 1 };
	my $scans = sub { return $board->('status') =~ /^scans: (\d+)$/m ? $1 : -1 };
	my $until = sub { my ($what) = @_; for (1 .. 3000) { return 1 if $what->(); sleep 0.02 } return 0 };
	{
		local $ENV{FAKE_HANG_AT} = 10;
		my $pid = start($fake, $rung, '--io', $gpio, '--trace-io', '--watchdog', '20');
		ok(until_has('err', qr/^%QX0\.1 1$/m), 'a scan hangs');
		$drain->();
		sleep 0.5; # ten times what it fed before; nothing can be waited for
		my $text;
		ok(!defined $socket->recv($text, 200, MSG_DONTWAIT), 'the service manager hears nothing more');
		kill 'KILL', $pid;
		finish($pid);
	}
	{
		my $pid = start($fake, $kept, '--io', $map, '--retain', "$dir/patience.keep", '--retain-period', '10ms', @linked);
		ok($until->(sub { $board->('status') =~ /^mode: RUN$/m && -s "$dir/patience.keep" }), 'retained values are written');
		put('hang', '');
		ok($until->(sub { $board->('status') =~ /^disk: retained values are not stored: Operation now in progress$/m }),
			'a write that hangs is told');
		my $before = $scans->();
		ok($until->(sub { $scans->() > $before + 10 }), 'the scan goes on');
		ok($fed->(), 'and the service manager is content');
		unlink "$dir/hang";
		ok($until->(sub { $board->('status') !~ /^disk:/m }), 'nothing is told any more when it has ended');
		kill 'TERM', $pid;
		is(finish($pid), 0, 'it ends');
	}
	{
		my $pid = start($fake, $kept, '--io', $map, '--slots', "$dir/slots", @linked);
		ok($until->(sub { $board->('status') =~ /^mode: RUN$/m }), 'the link works');
		unlike(get('err'), qr/the link/, 'nothing is told');
		put('hang', '');
		my $desk = fork // die "fork: $!";
		exec "$build/ladder board unix:$dir/link force Count=5 >$dir/desk 2>&1" if !$desk;
		ok(until_has('err', qr/the link does not answer, its disk perhaps hangs; the program goes on/), 'a link that hangs is told');
		my ($count, @scans) = (0);
		for my $time (1, 2) {
			kill 'USR1', $pid;
			$until->(sub { (@scans = get('out') =~ /^scans: (\d+)$/mg) == $time });
		}
		cmp_ok($scans[-1] // 0, '>=', $scans[0] // 1, 'the scan goes on');
		ok($fed->(), 'and the service manager is content');
		unlink "$dir/hang";
		ok(until_has('err', qr/the link answers again/), 'it comes back');
		waitpid $desk, 0;
		ok($board->('status') =~ /^forces: 1$/m, 'and has done what was ordered');
		kill 'TERM', $pid;
		is(finish($pid), 0, 'it ends');
	}
}

# ---- a reader that does not read, and one that is gone ----
{
	pipe my $read, my $write or die;
	my $blink = put('blink.rung', <<'END');
RUNGBOARD 1
PROJECT "Blink"

PROGRAM Main LD
RUNG
  | NO SYS_CLOCK_100MS | COIL Q0 |
END_PROGRAM
END
	unlink "$dir/err";
	my $pid = fork;
	if (!$pid) {
		open STDOUT, '>&', $write or die;
		open STDERR, '>', "$dir/err" or die;
		exec $ladderd, $blink, '--io', $map, @traced;
	}
	close $write;
	until_has('err', qr/^%QX0\.0 1$/m);
	for (1 .. 200) {
		kill 'USR1', $pid;
		sleep 0.005;
	}
	my $before = get('err');
	ok(until_has('err', qr/^\Q$before\E(%QX0\.0 [01]\n){5}/),
		'it scans on beside a full pipe');
	kill 'TERM', $pid;
	is(finish($pid), 0, 'a full pipe does not stop it');
	close $read;
	pipe $read, $write or die;
	close $read;
	$pid = fork;
	if (!$pid) {
		open STDOUT, '>&', $write or die;
		open STDERR, '>', "$dir/err" or die;
		exec $ladderd, $rung, '--io', $map, '--scans', '5', @traced;
	}
	close $write;
	is(finish($pid), 0, 'a closed pipe does not stop it');
	is_safe('closed pipe');
}

done_testing();
