#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# retain.t - tests ladderd --retain from outside: after a kill, a cut file, a full disk, a
# damaged file or an edited program. The test reads the file with its own code. RETAIN_KILLS
# is the number of kills (400).
use strict;
use warnings;
use Test::More;
use File::Temp qw(tempdir);
use FindBin;
use POSIX ();
use Time::HiRes qw(sleep time);
use lib "$FindBin::Bin/..";
use Files;
use Limit;

my $build = $ENV{BUILD} || 'build';
my $ladderd = "$build/ladderd";
my $kills = $ENV{RETAIN_KILLS} || 400;
my $lanes = 4;
my $dir = tempdir(CLEANUP => 1);
my $keep = "$dir/keep";
@Limit::show = ("$dir/err", "$dir/out");
delete @ENV{qw(NOTIFY_SOCKET WATCHDOG_USEC WATCHDOG_PID)};

sub put { return spew("$dir/$_[0]", $_[1]) }
sub get { return slurp(@_) // '' }
sub out { return get("$dir/out"); }
sub err { return get("$dir/err"); }

sub start_in {
	my ($where, @command) = @_;
	unlink "$where/out", "$where/err";
	my $pid = fork // die "fork: $!";
	return $pid if $pid;
	open STDOUT, '>', "$where/out" or POSIX::_exit(99);
	open STDERR, '>', "$where/err" or POSIX::_exit(99);
	open STDIN, '<', '/dev/null' or POSIX::_exit(99);
	exec @command or POSIX::_exit(99);
}
sub start { return start_in($dir, @_); }

sub run { return finish(start(@_)); }

# ---- reads the file: seq, and values by "NAME TYPE" ----
my @crc_table = map {
	my $crc = $_;
	$crc = $crc & 1 ? $crc >> 1 ^ 0x82f63b78 : $crc >> 1 for 1 .. 8;
	$crc;
} 0 .. 255;

sub crc32c {
	my $crc = 0xffffffff;
	$crc = $crc >> 8 ^ $crc_table[($crc ^ $_) & 255] for unpack 'C*', $_[0];
	return $crc ^ 0xffffffff;
}

sub read_slot {
	my ($bytes) = @_;
	return if length $bytes < 36;
	my ($magic, $format, $seq, $len) = unpack 'a8 V V V', $bytes;
	return if $magic ne 'RUNGKEEP' || $format != 1 || 36 + $len > length $bytes;
	return if crc32c(substr $bytes, 0, 32 + $len) !=
		unpack 'V', substr $bytes, 32 + $len, 4;
	my ($count, $at, %value) = (unpack('V', substr $bytes, 40, 4), 44);
	while ($count--) {
		my ($name, $type, $size) = unpack 'v C x V', substr $bytes, $at, 8;
		my ($n, $t, $v) = unpack "a$name a$type a$size",
			substr $bytes, $at + 8;
		$value{"$n $t"} = $v;
		$at += 8 + $name + $type + $size;
	}
	die "records end at $at" if $at != 32 + $len;
	return { seq => $seq, value => \%value };
}

sub best {
	my ($path) = @_;
	my $bytes = get($path);
	my $half = length($bytes) / 2;
	my @slot = grep { defined } map { scalar read_slot($_) }
		substr($bytes, 0, $half), substr($bytes, $half);
	@slot = sort { $b->{seq} <=> $a->{seq} } @slot;
	return $slot[0];
}
sub number { return unpack 'l<', $_[0]; }
sub kept {
	my ($name) = @_;
	my $best = best($keep) or return 'no copy';
	return $best->{value}{$name} // 'not there';
}

# Q0: warm, Q1: lost, Q2: the copy before.
sub flags {
	my %level = map { $_ => 0 } 0 .. 2;
	for (split /\n/, err()) {
		$level{$1} ||= $2 if /^%QX0\.([0-2]) ([01])$/;
	}
	return join '', map { $level{$_} } 0 .. 2;
}

my $tell = <<'END';
RUNG
  | NO SYS_WARM | --- | COIL Q0 |
RUNG
  | NO SYS_RETAIN_LOST | --- | COIL Q1 |
RUNG
  | NO SYS_RETAIN_OLD_COPY | --- | COIL Q2 |
END_PROGRAM
END
sub program {
	my ($vars, $rungs) = @_;
	return "RUNGBOARD 1\nPROJECT \"Keep\"\n\n$vars\nPROGRAM Main LD\n" .
		"VAR RETAIN\n  B : DINT;\nEND_VAR\n$rungs$tell";
}
my $count_vars = "VAR RETAIN\n  A : DINT;\n  C AT %MD8 : DINT;\n  T : TON;\n" .
	"  Mark AT %MX3.2 : BOOL;\nEND_VAR\n";
my $count_rungs = "RUNG\n  | [ A := A + 1 ] | [ B := B + 1 ] | [ C := C + 1 ] " .
	"| S Mark |\nRUNG\n  | NO Mark | TON T PT:=T#1h | COIL Q3 |\n";
my $count = put('count.rung', program($count_vars, $count_rungs));
my $io = put('sim.io', join '', "BOARD \"on a table\"\n",
	map { "%QX0.$_ sim safe=0\n" } 0 .. 3);
my @run = ('--io', $io, '--period', '1ms', '--trace-io', '--watchdog', '1000');
my @keep = (@run, '--retain', $keep);

# ---- arguments and messages ----
is(run($ladderd, $count, '--io', $io, '--check'), 0, '--check');
like(out(), qr/^retain: 40 bytes in 10 values$/m, 'says how much is retained');
like(err(), qr/warning LD316: RETAIN needs/, 'without --retain: told');
is(run($ladderd, $count, @keep, '--check'), 0, '--check --retain');
is(err(), '', 'nothing to tell');
ok(!-e $keep && !-e "$keep.new", 'and no file is made');
for (['--retain', ''], ['--retain-period', '9ms'], ['--retain-period', '2h'],
     ['--retain', "$dir/none/keep"], ['--retain', $dir],
     ['--retain', "$count/keep"]) {
	is(run($ladderd, $count, @run, @$_), 2, "refused: @$_");
	like(err(), qr/^ladderd: .*--retain/m, 'and says so');
	unlike(err(), qr/^%Q/m, 'no pin is touched');
}
SKIP: {
	skip 'ladder is not built here', 4 unless -x "$build/ladder";
	for (['--small', 1, qr/no names/], ['', 0, qr/a new file/]) {
		my ($small, $status, $text) = @$_;
		system "$build/ladder build $small $count -o $dir/image >/dev/null 2>&1";
		is(run($ladderd, "$dir/image", @keep, '--scans', '1'), $status,
			"an image $small");
		like(err(), $text, 'says so');
	}
	unlink $keep;
}

# ---- cold, warm, unchanged, edited ----
is(run($ladderd, $count, @keep, '--scans', '20'), 0, 'the first start');
like(err(), qr/a new file/, 'says so');
is(flags(), '000', 'is cold, and nothing is lost');
like(out(), qr/^retain: copy \d+, 10 values, \d+ writes, 0 failed$/m, 'status');
is(number(kept("$_ DINT")), 20, "$_ is kept") for qw(A Main.B C);
is(kept('Mark BOOL'), "\1", 'a bit of an area is kept');
my $elapsed = unpack 'q<', kept('T.ET TON.TIME');
is(run($ladderd, $count, @keep, '--scans', '5'), 0, 'the second');
is(flags(), '100', 'is warm');
is(number(kept("$_ DINT")), 25, "$_ goes on") for qw(A Main.B C);
my $later = unpack 'q<', kept('T.ET TON.TIME');
ok($later > $elapsed && $later < $elapsed + 2e9,
	'a timer goes on, and does not count the time between');
is(run($ladderd, $count, @keep, '--scans', '5', '--cold'), 0, '--cold');
is(flags(), '000', 'is cold');
is(number(kept('A DINT')), 5, 'from the beginning');
my $still = put('still.rung', program($count_vars,
	"RUNG\n  | [ A > B ] | --- | COIL Mark |\n" .
	"RUNG\n  | NO I1 | TON T PT:=T#1h | --- | [ C := 1 ] |\n"));
run($ladderd, $still, @keep, '--scans', '5');
my $copy = best($keep)->{seq};
is(run($ladderd, $still, @keep, '--scans', '300', '--retain-period', '10ms'), 0,
	'a program that changes nothing');
like(out(), qr/ 0 writes/, 'writes nothing');
is(best($keep)->{seq}, $copy, 'the same copy');

# A, now an INT, and C, now named E, are lost; D is new.
run($ladderd, $count, @keep, '--cold', '--scans', '7');
my $edited = put('edited.rung', program("VAR RETAIN\n  A : INT := 3;\n" .
	"  E : DINT;\n  D : DINT := 8;\n  Mark AT %MX9.1 : BOOL;\nEND_VAR\n",
	"RUNG\n  | [ B := B + 1 ] | [ E := D ] | [ A > 0 ] | COIL Mark |\n"));
is(run($ladderd, $edited, @keep, '--scans', '1'), 0, 'an edited program');
is(flags(), '110', 'warm, and values were lost');
like(err(), qr/lost: A DINT: now of another type\n/, 'one of another type');
like(err(), qr/lost: C DINT: no such/, 'one that is gone');
like(err(), qr/new: $_\n/, "$_ is new") for qw(A E D);
is(number(kept('Main.B DINT')), 8, 'the others are kept');
is(unpack('s<', kept('A INT')), 3, 'and not half of one');
is(run($ladderd, $edited, @keep, '--scans', '1'), 0, 'again');
is(flags(), '100', 'nothing was lost this time');

# ---- a constant of an edited program has priority over a retained pin ----
sub timer_program {
	return put('timer.rung', "RUNGBOARD 1\n\nVAR RETAIN\n  Delay : TON;\nEND_VAR\n\n" .
		"PROGRAM Main LD\nRUNG\n  | TON Delay PT:=$_[0] | COIL Q3 |\n$tell");
}
unlink $keep;
is(run($ladderd, timer_program('T#1h'), @keep, '--scans', '20'), 0, 'a delay of an hour');
unlike(err(), qr/^%QX0\.3 1/m, 'does not end');
is(run($ladderd, timer_program('T#5ms'), @keep, '--scans', '20'), 0, 'edited: of 5 ms');
is(flags(), '100', 'nothing was lost');
like(err(), qr/^%QX0\.3 1/m, 'ends');

# ---- a FIFO keeps its values; one of another type begins empty, which is reported ----
sub store_program {
	my ($block, $size) = @_;
	return put("store.rung", "RUNGBOARD 1\n\nVAR RETAIN\n  Queue : $block;\n  Number : DINT;\nEND_VAR\n" .
		"VAR\n  On : BOOL;\n  Weight : REAL;\nEND_VAR\n\nPROGRAM Main LD\nRUNG\n" .
		"  | [ On := not On ] | [ Number := Number + 1 ] |\nRUNG\n  | NO On | $block Queue " .
		($block =~ /REAL/ ? "IN:=Weight" : "IN:=Number") . " SIZE:=$size |\n$tell");
}
unlink $keep;
is(run($ladderd, store_program('FIFO', 60), @keep, '--scans', '20'), 0, 'a FIFO of ten values');
is_deeply([unpack '(l<)10', kept('Queue.value FIFO.DINT[64]')], [map { 2 * $_ + 1 } 0 .. 9],
	'all of them are in the file');
is(run($ladderd, store_program('FIFO', 5), @keep, '--scans', '4'), 0, 'edited: five have room');
is(flags(), '100', 'nothing was lost');
is(unpack('s<', kept('Queue.COUNT FIFO.INT')), 10, 'ten are there all the same');
is(unpack('l<', kept('Queue.value FIFO.DINT[64]')), 1, 'the oldest, too');
is(run($ladderd, store_program('FIFO_REAL', 5), @keep, '--scans', '2'), 0, 'edited: another type');
is(flags(), '110', 'lost, and it is told');
like(err(), qr/lost: Queue\.value FIFO\.DINT\[64\]: now of another type\n/, 'by its name');
is(unpack('s<', kept('Queue.COUNT FIFO_REAL.INT')), 1, 'it began empty');

# ---- written at once at SIGTERM and in a FAULT; a reset keeps the values of a whole scan ----
unlink $keep;
my @slow = (@keep, '--retain-period', '1h');
for my $signal (qw(TERM INT)) {
	my $pid = start($ladderd, $count, @slow);
	until_true(sub { err() =~ /^%QX0\.0 1$/m or err() =~ /new file/ });
	# On a busy machine some scans take long: the status has the number of scans.
	until_true(sub { kill 'USR1', $pid; sleep 0.02; (out() . err()) =~ /^scans: (?:1[2-9]|[2-9]\d|\d{3,})$/m });
	kill $signal, $pid;
	is(finish($pid), 0, "SIG$signal");
	like(out() . err(), qr/\S/, 'ran');
	ok(number(kept('A DINT')) > 10, 'what changed was written at once');
	ok(kept('A DINT') eq kept('Main.B DINT'), 'of one scan');
}
unlink $keep;
my $fault = put('fault.rung', program($count_vars, <<'END'));
RUNG
  | [ A := A + 1 ] |
RUNG Again
  | [ A MOD 50 = 0 ] | --- | JMP Again |
RUNG
  | [ B := B + 1 ] | [ C := C + 1 ] | S Mark |
RUNG
  | NO Mark | TON T PT:=T#1h | COIL Q3 |
END
{
	my $pid = start($ladderd, $fault, @slow, '--period', '5ms');
	ok(until_true(sub { err() =~ /FAULT/ }), 'a FAULT in the middle of a scan');
	ok(until_true(sub { -e $keep && number(kept('A DINT')) == 49 }),
		'what the last whole scan left is written');
	is(number(kept('Main.B DINT')), 49, 'and nothing of the other');
	kill 'HUP', $pid;
	ok(until_true(sub { err() =~ /reset, RUN(.*\n)*.*FAULT/ }), 'a reset');
	like(err(), qr/reset, RUN\n(.*\n)*%QX0\.0 1\n|FAULT/, 'is a warm start');
	kill 'TERM', $pid;
	is(finish($pid), 1, 'still in FAULT');
	is(number(kept('Main.B DINT')), 49, 'still of the last whole scan');
}

# ---- tasks and wall clock: only timers continue ----
# The copy is from a machine that ran for 100 days.
sub date { return POSIX::strftime('DT#%Y-%m-%d-00:00:00', localtime(time + $_[0])); }
my ($yesterday, $tomorrow) = (date(-86400), date(2 * 86400));
my $tasks = put('tasks.rung', <<"END");
RUNGBOARD 1
PROJECT "Keep"

CONFIGURATION Keep
RESOURCE Cpu ON LINUX
TASK Fast (INTERVAL := T#2ms, PRIORITY := 1);
TASK Slow (INTERVAL := T#10ms, PRIORITY := 2);
PROGRAM P1 WITH Fast : A;
PROGRAM P2 WITH Slow : B;
END_RESOURCE
END_CONFIGURATION

PROGRAM A LD
VAR RETAIN
  N : DINT;
  T : TON;
END_VAR
RUNG
  | [ N := N + 1 ] | --- | TON T PT:=T#1h |
RUNG
  | [ SYS_DATE_TIME > $yesterday ] | [ SYS_DATE_TIME < $tomorrow ] | COIL Q3 |
END_PROGRAM

PROGRAM B LD
VAR RETAIN
  N : DINT;
END_VAR
RUNG
  | [ N := N + 1 ] |
$tell
END
{
	my @tasks = ('--io', $io, '--trace-io', '--watchdog', '1000', '--retain',
		$keep, '--scans', '100');
	unlink $keep;
	is(run($ladderd, $tasks, @tasks), 0, 'tasks');
	my $slot = substr get($keep), 0, 4096;
	my $len = unpack 'V', substr $slot, 16, 4;
	my $begun = unpack 'q<', substr $slot, 32, 8;
	my $start = unpack 'q<', kept('A.T.start TON.TIME');
	substr($slot, 32, 8) = pack 'q<', $begun + 8640000e9;
	$slot =~ s/(A\.T\.startTON\.TIME).{8}/$1 . pack 'q<', $start + 8640000e9/se;
	substr($slot, 32 + $len, 4) = pack 'V', crc32c(substr $slot, 0, 32 + $len);
	put('keep', $slot . "\0" x 4096);
	is(run($ladderd, $tasks, @tasks), 0, 'of a machine that ran longer');
	is(flags(), '100', 'are kept');
	is(number(kept('A.N DINT')), 200, 'a fast one');
	ok(number(kept('B.N DINT')) > 30, 'a slow one, beside it')
		or diag(number(kept('B.N DINT')));
	like(err(), qr/^%QX0\.3 1$/m, 'date and time are those of the wall');
	my $et = unpack 'q<', kept('A.T.ET TON.TIME');
	ok($et > 0.3e9 && $et < 60e9, 'a timer goes on') or diag($et);
}

# ---- damaged files ----
unlink $keep;
run($ladderd, $count, @keep, '--scans', '30', '--retain-period', '10ms') for 1 .. 2;
my $good = get($keep);
my $newest = best($keep)->{seq};
my $first = (read_slot(substr $good, 0, 4096) // {})->{seq} // 0;
my $at = $first == $newest ? 0 : 4096;
{
	my $bad = $good;
	substr($bad, $at + 100, 1) ^= "\1";
	put('keep', $bad);
	my $before = best($keep);
	is($before->{seq}, $newest - 1, 'the newest copy is broken');
	is(run($ladderd, $count, @keep, '--scans', '1'), 0, 'it runs');
	is(flags(), '101', 'with the copy before, and says so');
	is(number(kept('A DINT')), number($before->{value}{'A DINT'}) + 1,
		'which goes on');
	is(run($ladderd, $count, @keep, '--scans', '1'), 0, 'again');
	is(flags(), '100', 'all is well again');
}
my %broken = (
	'empty' => '', 'one byte' => 'R', 'zeros' => "\0" x 8192,
	'text' => "not a copy\n" x 2000, 'noise' => join('', map { chr rand 256 } 1 .. 9001),
	'both slots' => do {
		my $bad = $good;
		substr($bad, $_, 1) ^= "\4" for 60, 4156;
		$bad;
	},
);
for my $what (sort keys %broken) {
	put('keep', $broken{$what});
	is(run($ladderd, $count, @keep, '--scans', '3'), 0, "broken file: $what");
	is(flags(), '010', 'values were lost');
	is(number(kept('A DINT')), 3, 'all of them; new ones are stored');
	is(-s $keep, 8192, 'in a whole file');
}
{
	my $bad = 0;
	for (my $cut = 1; $cut < 8192; $cut += 331) {
		put('keep', substr $good, 0, $cut);
		my $copy = best($keep);
		my $status = run($ladderd, $count, @keep, '--scans', '1');
		my $slot = read_slot(substr $good, 0, $cut < 4096 ? $cut : 4096);
		my $whole = read_slot(substr($good, 4096, $cut - 4096 > 0 ?
			$cut - 4096 : 0));
		my $had = $whole && $whole->{seq} == $newest ? $whole : $slot;
		my $want = ($had ? number($had->{value}{'A DINT'}) : 0) + 1;
		my $flag = !$had ? '010' : '100|101';
		next if $status eq '0' && number(kept('A DINT')) == $want &&
			flags() =~ /^(?:$flag)$/;
		$bad++;
		diag("cut at $cut: ", kept('A DINT') ? number(kept('A DINT')) : '',
			" $want ", flags());
	}
	is($bad, 0, 'a file that was cut: a whole copy, or a flag');
}
{
	put('keep', '');
	truncate $keep, 1 << 30;
	is(run($ladderd, $count, @keep, '--scans', '1'), 0, 'a file of 1 GB');
	is(flags(), '010', 'values were lost');
	put('keep', $good);
	my $pid = start($ladderd, $count, @slow);
	until_true(sub { err() =~ /^%QX0\.0 1$/m });
	my $status = finish(start_in(tempdir(CLEANUP => 1), $ladderd, $count, @keep));
	is($status, 1, 'a second ladderd is refused');
	kill 'KILL', $pid;
	waitpid $pid, 0;
}

# ---- disks that are full ----
my $wide_vars = $count_vars . "VAR RETAIN\n" .
	join('', map { "  Value_$_ : DINT;\n" } 1 .. 600) . "END_VAR\n";
my $wide = put('wide.rung', program($wide_vars, $count_rungs .
	join('', map { "RUNG\n  | [ Value_$_ := A ] |\n" } 1 .. 600)));
{
	# In units of 512 bytes: less than two slots.
	my @limited = ('sh', '-c', 'ulimit -f 15; exec "$@"', 'sh');
	unlink $keep;
	is(run(@limited, $ladderd, $count, @keep, '--scans', '50', '--retain-period',
		'10ms'), 0, 'no room for a new file: it runs');
	like(err(), qr/values are not stored/, 'says so');
	like(out(), qr/^retain: copy 0, .* 0 writes, [1-9]\d* failed$/m,
		'status knows');
	ok(!-e $keep && !-e "$keep.new", 'nothing is left behind');
	put('keep', $good);
	is(run(@limited, $ladderd, $count, @keep, '--scans', '20'), 0,
		'an old file that is large enough');
	like(out(), qr/ [1-9]\d* writes, 0 failed$/m, 'needs no room');
	put('keep', $good);
	is(run('sh', '-c', 'ulimit -f 18; exec "$@"', 'sh', $ladderd, $wide, @keep,
		'--scans', '20'), 0, 'one that is too small');
	is(flags(), '100', 'its values are kept');
	is(get($keep), $good, 'it stays as it was');
	is(run($ladderd, $wide, @keep, '--scans', '1'), 0, 'with room again');
	ok(-s $keep > 16384 && number(kept('A DINT')) ==
		number(read_slot(substr $good, $at, 4096)->{value}{'A DINT'}) + 1,
		'it is replaced, and goes on');
	mkdir "$keep.new";
	put('keep', $good);
	is(run($ladderd, $wide, @keep, '--scans', '5'), 0, 'no new file can be made');
	like(err(), qr/values are not stored/, 'says so');
	is(get($keep), $good, 'the old one stays');
	rmdir "$keep.new";
}

# A real full disk, where this process may mount. 24 KB: room for one file only.
SKIP: {
	my $disk = "$dir/disk";
	mkdir $disk;
	my @mount = ('unshare', '-m', 'sh', '-c', 'mount -t tmpfs -o size=24k x ' .
		"$disk || exit 77; " . '"$@"', 'sh');
	skip 'no mounts here', 5 if system('sh', '-c',
		'exec "$@" >/dev/null 2>&1', 'sh', @mount, 'true') != 0;
	my $on = "$ladderd @run --retain $disk/keep --scans 20";
	my $script = put('disk.sh', "cat /dev/zero >$disk/fill 2>/dev/null\n" .
		"$on $count\nrm $disk/fill\n$on $count\n" .
		"cat /dev/zero >$disk/fill 2>/dev/null\n$on $count\n$on $wide\n" .
		"rm $disk/fill\nmount -o remount,ro $disk\n$on $count\n");
	is(run(@mount, 'sh', $script), 0, 'a full disk');
	like(err(), qr/\A[^\0]*?No space left on device; values are not stored; make room on the disk/,
		'a first start tells');
	my @status = out() =~ /^retain: copy (\d+), \d+ values, (\d+) writes, (\d+) f/mg;
	ok($status[1] == 0 && $status[4] > 0 && $status[7] > 0 && $status[8] == 0,
		'one that has its file does not mind') or diag("@status");
	ok($status[10] == 0 && $status[9] == $status[6],
		'one that needs a larger file keeps the old') or diag("@status");
	like(err(), qr/Read-only file system; values are not stored/,
		'a disk that can only be read');
}

# ---- killed at random moments ----
sub lane {
	my ($lane, $rounds, $file) = @_;
	my $where = "$dir/lane$lane";
	my ($seq, $value, $torn, $told, $read) = (0, 0, 0, 0, 0);
	srand($$);
	mkdir $where;
	# Measures the time of a start and a first copy.
	my $begin = time;
	finish(start_in($where, $ladderd, $file, @run, '--retain', "$where/keep",
		'--scans', '2'));
	my $most = time - $begin + 0.03;
	my $first = best("$where/keep") or return 'no first copy';
	($seq, $value) = ($first->{seq}, number($first->{value}{'A DINT'}));
	for my $round (1 .. $rounds) {
		my $pid = start_in($where, $ladderd, $file, @run, '--retain',
			"$where/keep", '--retain-period', '10ms');
		my $known = 0;
		sleep rand $most;
		if ($round % 4 == 0) {
			kill 'USR1', $pid;
			sleep 0.004;
			($known) = get("$where/out") =~ /^retain: copy (\d+)/m;
			$known ? $told++ : ($known = 0);
		} elsif ($round % 4 == 1) {
			my $now = best("$where/keep");
			$known = $now ? $now->{seq} : 0;
			$read++;
		}
		kill 'KILL', $pid;
		waitpid $pid, 0;
		my ($begun) = get("$where/err") =~ /values of copy (\d+)/;
		return "round $round: began with copy $begun, not $seq"
			if defined $begun && $begun != $seq;
		return "round $round: lost" if get("$where/err") =~ /lost/;
		next unless -e "$where/keep";
		my $bytes = get("$where/keep");
		my $half = length($bytes) / 2;
		$torn += grep { !read_slot($_) && /[^\0]/ }
			substr($bytes, 0, $half), substr($bytes, $half);
		my $best = best("$where/keep") or return "round $round: no copy";
		my %v = map { $_ => number($best->{value}{"$_ DINT"}) }
			'A', 'Main.B', 'C', map { "Value_$_" } 1, 300, 600;
		return "round $round: a mix: " . join ' ', %v
			if grep { $_ != $v{A} } values %v;
		return "round $round: copy $best->{seq} after $seq, $known"
			if $best->{seq} < $seq || $best->{seq} < $known;
		return "round $round: $v{A} after $value" if $v{A} < $value;
		return "round $round: a new copy, an old value"
			if $v{A} == $value && $best->{seq} > $seq;
		($seq, $value) = ($best->{seq}, $v{A});
	}
	return "good: copy $seq, value $value, $torn torn, $told told, $read read";
}
{
	my $file = $wide;
	$file = "$dir/wide.rungc" if -x "$build/ladder" &&
		system("$build/ladder build $wide -o $dir/wide.rungc 2>/dev/null") == 0;
	my @pid;
	for my $lane (1 .. $lanes) {
		my $pid = fork // die "fork: $!";
		push @pid, $pid;
		next if $pid;
		my $said = eval { lane($lane, $kills / $lanes, $file) } // "died: $@";
		put("said$lane", $said);
		POSIX::_exit(0);
	}
	waitpid $_, 0 for @pid;
	for my $lane (1 .. $lanes) {
		my $said = get("$dir/said$lane");
		like($said, qr/^good: copy [1-9]/, "killed " . $kills / $lanes .
			" times, lane $lane: $said");
	}
}
done_testing();
