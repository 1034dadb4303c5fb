#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# classic_export.t - exports to ClassicLadder do the same as the program.
#
# Each project of tests/classic/projects/ is exported. The export gives the trace of the
# original, with `ladder trace` and with the second evaluator, and a strict reader accepts it
# (ClassicTest). Its text stays the same after another import and export. The same with random
# projects, samples and random ladders. A table has a row for each thing that ClassicLadder
# does not have: it is refused with its place, or reported. With SAMPLES=DIR also the projects
# of DIR and DIR/classicladder.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(basename dirname);
use File::Temp qw(tempdir);
use Test::More;

use lib dirname(abs_path(__FILE__));
use ClassicTest;

chdir dirname(abs_path(__FILE__)) . '/..' or die;
my $build = $ENV{BUILD} || 'build';
my $ladder = $ENV{LADDER} || "$build/ladder";
my $second = "$build/tests/bin/classic_trace";
my $random = "$build/tests/bin/classic_random";
my $random_ladder = "$build/tests/bin/ladder_random";
my $ours = 'tests/classic/projects';
my $dir = tempdir(CLEANUP => 1);
my $many = $ENV{EXPORT_COUNT} || 25; # of each kind of random program

# The exported file and the messages; undef: it was refused.
sub export {
	my ($project, $as, $name, @more) = @_;
	my $out = "$dir/$name.clprj";
	unlink $out;
	my $told = run('sh', '-c', 'exec "$@" 2>&1', 'sh', $ladder, 'export', '--as', $as, @more,
		$project, '-o', $out);
	return wantarray ? (-e $out ? $out : undef, $told) : -e $out ? $out : undef;
}

sub taken {
	my ($what, $out, %option) = @_;
	my @wrong = strict(slurp($out), %option);
	ok(!@wrong, "$what: ClassicLadder takes it") or diag(join "\n", @wrong[0 .. ($#wrong > 4 ? 4 : $#wrong)]);
}

sub same_trace {
	my ($what, $project, $script, $out) = @_;
	my $want = run($ladder, 'trace', '--changes', $project, $script);
	is(run($ladder, 'trace', '--changes', $out, $script), $want, "$what: the same trace");
	is(run($second, '--changes', $out, $script), run($second, '--changes', $project, $script),
		"$what: the second evaluator");
}

# The text of a second and third import is the same.
sub stays {
	my ($what, $project, $as) = @_;
	my @text;
	my $from = $project;
	for my $round (1 .. 3) {
		my $rung = "$dir/again$round.rung";
		unlink $rung, "$dir/again$round.io";
		run($ladder, 'import', $from, '-o', $rung);
		my $text = slurp($rung);
		return fail("$what: import $round") unless defined $text;
		push @text, $text =~ s/^PROJECT .*\n//mr . (slurp("$dir/again$round.io") // '');
		last if $round == 3;
		$from = export($rung, $as, "again$round");
		return fail("$what: export $round") unless defined $from;
	}
	is($text[2], $text[1], "$what: the text of the second import stays");
}

# ---- projects of ClassicLadder ----

# Projects that only LinuxCNC can hold, and options for strict().
my %as = ('crlf' => 'linuxcnc', 'linuxcnc' => 'linuxcnc'); # numbers with a point
my %knows = ('charts' => [steps => 1], 'faults' => [steps => 1], 'crlf' => [power => 1],
	'linuxcnc' => [power => 1]);

sub test_ours {
	for my $script (sort glob("$ours/*.script")) {
		my $base = $script =~ s/\.script$//r;
		my $name = basename($base);
		my $project = project_of($base);
		my $as = $as{$name} || 'classicladder';
		my $out = export($project, $as, $name);
		ok(defined $out, "$name as $as") or next;
		taken($name, $out, lc => $as eq 'linuxcnc', @{ $knows{$name} || [] });
		same_trace($name, $project, $script, $out);
		stays($name, $project, $as);
	}
}

sub test_samples {
	my @folders = grep { my @any = glob("$_/*.clp*"); @any } $ENV{SAMPLES}, "$ENV{SAMPLES}/classicladder";
	ok(scalar @folders, "ClassicLadder projects in $ENV{SAMPLES}");
	for my $project (map { sort glob("$_/*.clp*") } @folders) {
		my $name = basename($project) =~ s/\..*//r;
		my $as = $name =~ /-lc$/ ? 'linuxcnc' : 'classicladder';
		my $out = export($project, $as, $name);
		ok(defined $out, "$name as $as") or next;
		taken($name, $out, lc => $as eq 'linuxcnc');
		for my $script (grep { -e } map { $project =~ s/\.clp\w*$/$_.script/r } '', '.a', '.b') {
			# Bits that the LinuxCNC project does not use can be bits between rungs in the export.
			my $text = slurp($script);
			$text =~ s/ %B\d+(\.\.\d+)?//g if $as eq 'linuxcnc';
			spew("$dir/sample.script", $text);
			same_trace($name, $project, "$dir/sample.script", $out);
		}
		stays($name, $project, $as);
	}
}

# Takes steps of pages that no section shows out of a script: they are bits in the export.
sub only_shown_steps {
	my ($project, $script) = @_;
	my ($members) = members(slurp($project));
	my %shown = map { $_ => 1 } $members->{'sections.csv'} =~ /^\d+,1,.*,(\d+)$/mg;
	my (%lost, %kept);
	while ($members->{'sequential.csv'} =~ /^S\d+,\d+,(\d+),(\d+),/mg) {
		($shown{$2} ? \%kept : \%lost)->{$1} = 1;
	}
	my $text = slurp($script);
	for my $step (grep { !$kept{$_} } keys %lost) {
		$text =~ s/ %X$step\.[AV]\b//g;
	}
	spew($script, $text);
}

sub test_random {
	for my $seed (1 .. $many) {
		run($random, $seed, "$dir/r$seed");
		only_shown_steps("$dir/r$seed.clprj", "$dir/r$seed.script");
		my $out = export("$dir/r$seed.clprj", 'classicladder', "out$seed");
		next unless defined $out;
		same_trace("seed $seed", "$dir/r$seed.clprj", "$dir/r$seed.script", $out);
	}
}

sub test_numeric {
	my $out = export("$ours/numeric.txt", 'numeric', 'numeric');
	my $again = defined $out ? export($out, 'numeric', 'again') : undef;
	is(defined $again ? slurp($again) : '', defined $out ? slurp($out) : 'none',
		'numeric: the second text is the first');
	same_trace('numeric', "$ours/numeric.txt", "$ours/numeric.script", $out) if defined $out;
}

# ---- ladders that are no import ----

# By symbol: the name of the variable in the export.
sub names_there {
	my ($out) = @_;
	my ($members) = members(slurp($out));
	my %name;
	while ($members->{'symbols.csv'} =~ /^(%\w+),([^,\n]+),/mg) {
		$name{$2} //= $1;
	}
	return \%name;
}

# Runs the script with names of the export, and compares traces with names of the ladder.
sub ladder_runs_the_same {
	my ($what, $rung, $script, $out) = @_;
	my $name = names_there($out);
	my $text = slurp($script);
	my %back;
	my ($shown) = $text =~ /^\@print (.*)$/m;
	my @there = map { /^%/ ? $_ : $name->{$_} // () } split ' ', $shown;
	is(scalar(grep { !/^%/ && !exists $name->{$_} } split ' ', $shown), 0, "$what: symbols");
	$back{ $name->{$_} } = $_ for grep { exists $name->{$_} } split ' ', $shown;
	$text =~ s/^\@print .*$/'@print ' . join ' ', @there/me;
	spew("$dir/there.script", $text);
	my $want = run($ladder, 'trace', '--changes', $rung, $script);
	for my $with ([$ladder, 'trace'], [$second]) {
		my $got = run(@$with, '--changes', $out, "$dir/there.script");
		$got =~ s/(%[A-Z]+\d+)=/($back{$1} \/\/ $1) . '='/ge;
		is($got, $want, "$what: the trace of " . basename($with->[0]));
	}
}

# Each coil of the ladder is in the export or in a line of the report; bits between rungs are
# more coils.
sub keeps_coils {
	my ($what, $rung, $export, $told) = @_;
	$rung =~ s/^RUNG OFF.*?(?=^RUNG|^END_)//msg;
	for my $row (['COIL', 50], ['COILNOT', 51], ['S', 52], ['R', 53]) {
		my ($word, $code) = @$row;
		my $in = grep { /^\s*$word \S+\s*$/ } map { split /\|/ } grep { /^ *\|/ } split /\n/, $rung;
		my $out = () = $export =~ /(?:^|, )$code-/mg;
		my $lost = () = $told =~ /lost: "$word /g;
		cmp_ok($out + $lost, '>=', $in, "$what: $word");
	}
}

sub test_random_ladders {
	my $written = 0;
	for my $seed (1 .. 2 * $many) {
		my $as = $seed % 2 ? 'classicladder' : 'linuxcnc';
		run($random_ladder, $seed, "$dir/l$seed");
		my ($out, $told) = export("$dir/l$seed.rung", $as, "ladder$seed");
		if (!defined $out) {
			like($told, qr/rung \d+ \(\d+,\d+\): error LD739/, "ladder $seed: why not");
			next;
		}
		$written++;
		taken("ladder $seed", $out, lc => $as eq 'linuxcnc');
		keeps_coils("ladder $seed", slurp("$dir/l$seed.rung"), slurp($out), $told);
		next if $told =~ /stops in ClassicLadder/;
		ladder_runs_the_same("ladder $seed as $as", "$dir/l$seed.rung", "$dir/l$seed.script", $out);
	}
	cmp_ok($written, '>', $many, 'most random ladders can be exported');
}

# Samples: random inputs, outputs by address, with the period of the export.
sub test_ladders {
	my $written = 0;
	for my $rung (sort glob('ladders/*.rung')) {
		my $name = basename($rung) =~ s/\.rung$//r;
		my ($out, $told) = export($rung, 'classicladder', $name);
		if (!defined $out) {
			like($told, qr/^\S+:\d+.*: error LD7\d\d: /m, "$name: refused with its place");
			next;
		}
		$written++;
		taken($name, $out);
		next if $told =~ /SYS_CLOCK/; # reported: clocks begin at another time
		srand 7;
		my $script = "\@period 50\n\@print %Q0..15\n" . join '', map {
			sprintf "%%I%d=%d . x%d\n", int rand 12, int rand 2, 1 + int rand 20;
		} 1 .. 80;
		spew("$dir/$name.script", $script);
		my $want = run($ladder, 'trace', '--changes', $rung, "$dir/$name.script");
		is(run($ladder, 'trace', '--changes', $out, "$dir/$name.script"), $want, "$name: the same trace");
		is(run($second, '--changes', $out, "$dir/$name.script"), $want, "$name: the second evaluator");
	}
	cmp_ok($written, '>=', 5, 'samples that can be exported');
}

# ---- what ClassicLadder does not have ----

my $body = "PROGRAM Main LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n";
sub with_rung { return "VAR\n$_[0]\nEND_VAR\nPROGRAM Main LD\nRUNG\n  $_[1]\nEND_PROGRAM\n" }
sub with_task { return "CONFIGURATION C\nTASK T (INTERVAL := $_[0]);\n PROGRAM M WITH T : Main;\nEND_CONFIGURATION\n$body" }

# What, the file, the message (-: none; with LD: it is refused), text in the export.
my @table = (
	['RETAIN', "VAR RETAIN\n a : BOOL;\nEND_VAR\n" . with_rung(' b : BOOL;', '| NO a | COIL a |'),
		':3: changed: a: ClassicLadder retains no values'],
	['a narrow number', with_rung(' n : INT;', '| [ n := 3 ] |'), ':3: changed: n has 32 bits in ClassicLadder, more than INT has'],
	['32 bits', with_rung(' n : DINT;', '| [ n := 3 ] |'), '-', qr/^0000,\@200\/100\@:=3$/m],
	['a sum', with_rung(' n : DINT;', '| [ n := n + 3 ] |'), 'changed: arithmetic that overflows wraps in ClassicLadder'],
	['a division', with_rung(' n : DINT;', '| [ n := 3 / n ] |'), 'changed: a division by 0 gives 0 in ClassicLadder'],
	['a division by 2', with_rung(' n : DINT;', '| [ n := n / 2 ] |'), '-', qr/:=\@200\/100\@\/2$/m],
	['REAL', with_rung(' x : REAL;', '| [ x := 1.5 ] |'), ':7: rung 1 (1,1): error LD730: "x"'],
	['REAL that nobody uses', with_rung(' x : REAL;', '| NO %IX0.0 | COIL %QX0.0 |'), ':3: changed: x is not exported'],
	['an initial value', with_rung(' n : DINT := 5;', '| [ n > 3 ] | COIL %QX0.0 |'), '-', qr/\@200\/100\@:=5$/m],
	['values of an array', with_rung(' n : ARRAY[1..2] OF DINT := [4, 5];', '| [ n[2] > 3 ] | COIL %QX0.0 |'),
		'changed: n: ClassicLadder has no names for arrays', qr/\@200\/101\@:=5$/m],
	['an index', with_rung(" n : ARRAY[1..2] OF DINT;\n i : DINT;", '| [ n[i] > 3 ] | COIL %QX0.0 |'),
		'changed: an index outside its array'],
	['one memory for two', with_rung(" n AT %MW0 : INT;\n b AT %MX0.3 : BOOL;", '| NO b | [ n := 3 ] |'), 'error LD730: "n"'],
	['a word of its own', with_rung(' n AT %MW0 : INT;', '| [ n := 3 ] |'), 'changed: n has 32 bits'],
	['VAR_TEMP', "PROGRAM Main LD\nVAR_TEMP\n t : BOOL;\nEND_VAR\nRUNG\n  | NO %IX0.0 | S t |\nRUNG\n  | NO t | COIL %QX0.0 |\nEND_PROGRAM\n",
		'-', qr{53-0-0/300\n}],
	['a comment of a cell', "PROGRAM Main LD\nRUNG\n  | NO %IX0.0 (* door *) | COIL %QX0.0 |\nEND_PROGRAM\n",
		':4: changed: 1 comment is not exported'],
	['a comment of a variable', with_rung(' b : BOOL; (* the pump *)', '| NO b | COIL %QX0.0 |'), '-', qr/^%B300,b,the pump$/m],
	['a long one', with_rung(' b : BOOL; (* the pump in the cellar, on the left *)', '| NO b | COIL %QX0.0 |'),
		':3: changed: the comment of b is cut to 29 bytes'],
	['a title', "PROGRAM Main LD\nRUNG \"Seal\"\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n", '-', qr/^#COMMENT=Seal$/m],
	['a long title', "PROGRAM Main LD\nRUNG \"" . 'x' x 120 . "\"\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n",
		'changed: a title is cut to 99 bytes'],
	['a long label', "PROGRAM Main LD\nRUNG LabelOfMany\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n",
		'changed: label LabelOfMany is cut to 9 bytes'],
	['a long name', with_rung(' NameOfMany : BOOL;', '| NO NameOfMany | COIL %QX0.0 |'),
		':3: changed: NameOfMany is called NameOfMan in ClassicLadder'],
	['a long program', "PROGRAM ProgramWithALongName LD\nRUNG\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n",
		'changed: section ProgramWithALongName is called ProgramWithALongNam'],
	['a long project', "PROJECT \"" . 'x' x 40 . "\"\n$body", "changed: the project's name is cut"],
	['no task', $body, 'changed: no task gives the period: ClassicLadder uses 50 ms'],
	['a task', with_task('T#20ms'), '-', qr/^PERIODIC_REFRESH=20$/m],
	['half a millisecond', with_task('T#500us'), 'changed: T: ClassicLadder needs whole milliseconds; it uses 1 ms'],
	['a watchdog', with_task('T#20ms, WATCHDOG := T#1s'), 'changed: T: ClassicLadder does not monitor the length of a scan'],
	['an event', "VAR\n e AT %IX0.0 : BOOL;\nEND_VAR\nCONFIGURATION C\n TASK T (SINGLE := e);\n PROGRAM M WITH T : Main;\nEND_CONFIGURATION\n$body", 'error LD737'],
	['a size', "CONFIGURATION C\n AREA V 16384;\nEND_CONFIGURATION\n$body", 'changed: AREA: ClassicLadder has its own area sizes'],
	['a program without a task', with_task('T#20ms') . $body =~ s/Main/Other/r,
		'changed: PROGRAM Other is not exported'],
	['what the editor keeps', "${body}VIEW\n  bookmark Main 1\nEND_VIEW\n", 'changed: settings of the editor (VIEW) are not exported'],
	['a structure', "TYPE\n Pair : STRUCT\n  a : BOOL;\n END_STRUCT;\nEND_TYPE\n$body", 'changed: structure Pair is not exported'],
	['a function', "FUNCTION F : BOOL LD\nRUNG\n  | NO %IX0.0 | COIL F |\nEND_FUNCTION\n$body", 'changed: FUNCTION F is not exported'],
	['a function that is called', "FUNCTION Sum : DINT LD\nVAR_INPUT\n A : DINT; B : DINT;\nEND_VAR\nRUNG\n  | [ Sum := A * B ] |\nEND_FUNCTION\n"
		. with_rung(' n : DINT;', '| [ n := Sum(n, 2) ] |'), 'error LD732: "Sum"'],
	['a list', "PROGRAM Main IL\n LD %IX0.0\n ST %QX0.0\nEND_PROGRAM\n", 'error LD736'],
	['a rung that is off', "PROGRAM Main LD\nRUNG OFF\n  | NO %IX0.0 | COIL %QX0.0 |\nEND_PROGRAM\n", 'changed: a rung that is switched off'],
	['an output without power', with_rung(' b : BOOL;', "| NO %IX0.0 | NOT | COIL b |\n  | NC SYS_ALWAYS_ON | NO %IX0.1 | S %QX0.0 |"),
		':8: lost: "NO %IX0.1" never has power'],
	['STOP', with_rung(' b : BOOL;', '| NO b | STOP |'), 'error LD731: "STOP"'],
	['FOR', "VAR\n i : DINT;\nEND_VAR\nPROGRAM Main LD\nRUNG\n  | FOR i := 1 TO 3 |\nRUNG\n  | NEXT |\nEND_PROGRAM\n", 'error LD731: "FOR"'],
	['a timer', with_rung(' t : TON;', '| NO %IX0.0 | TON t PT:=T#3s | COIL %QX0.0 |'),
		'changed: in ClassicLadder, timers (%TM) that are cut short', qr/^TM0,2,30,0$/m],
	['its declared time', with_rung(' t : TOF := (PT := T#3s);', '| NO %IX0.0 | TOF t | COIL %QX0.0 |'),
		'changed: in ClassicLadder, timers', qr/^TM0,2,30,1$/m],
	['a time of a variable', with_rung(" t : TON;\n p : TIME := T#3s;", '| NO %IX0.0 | TON t PT:=p | COIL %QX0.0 |'),
		'changed: p is fixed in ClassicLadder', qr/^TM0,2,30,0$/m],
	['a time between', with_rung(' t : TON;', '| NO %IX0.0 | TON t PT:=T#1ms | COIL %QX0.0 |'), 'error LD733'],
	['a unit shorter than a scan', "CONFIGURATION C\n TASK T (INTERVAL := T#200ms);\n PROGRAM M WITH T : Main;\nEND_CONFIGURATION\n"
		. with_rung(' t : TON;', '| NO %IX0.0 | TON t PT:=T#300ms | COIL %QX0.0 |'), 'error LD733'],
	['two places', "VAR\n t : TON;\nEND_VAR\nPROGRAM Main LD\n" . "RUNG\n  | NO %IX0.0 | TON t PT:=T#1s | COIL %QX0.0 |\n" x 2 . "END_PROGRAM\n", 'rung 2 (1,2): error LD739'],
	['a subroutine called twice', "VAR\n t : TON;\nEND_VAR\nPROGRAM Main LD\n" . "RUNG\n  | NO %IX0.0 | CALL Sub |\n" x 2
		. "END_PROGRAM\nSUBROUTINE Sub LD\nRUNG\n  | NO %IX0.0 | TON t PT:=T#1s | COIL %QX0.0 |\nEND_SUBROUTINE\n", 'error LD739'],
	['a timer that may be jumped over', "VAR\n t : TON;\nEND_VAR\nPROGRAM Main LD\nRUNG\n  | NO %IX0.0 | RET |\n"
		. "RUNG\n  | NO %IX0.0 | TON t PT:=T#1s | COIL %QX0.0 |\nEND_PROGRAM\n", ':9: changed: timer t stops in ClassicLadder while its rung is skipped'],
	['a counter', with_rung(' c : CTU := (PV := 7);', '| NO %IX0.0 | CTU c | COIL %QX0.0 |'), 'changed: counter c counts from 0 to 9999', qr/^C0,7$/m],
	['a counter that begins elsewhere', with_rung(' c : CL_COUNTER := (P := 3, V := 2);', '| NO %IX0.0 | CL_COUNTER c | COIL %QX0.0 |'), 'error LD731'],
	['a monostable of 75 ms', with_rung(' m : CL_MONO := (P := 1, BASE := T#100ms);', '| NO %IX0.0 | CL_MONO m DT:=SYS_CYCLE | COIL %QX0.0 |'), '-', qr/^M0,2,1$/m],
	['a clock', with_rung(' b : BOOL;', '| NO SYS_CLOCK_1S | COIL b |'), 'changed: in ClassicLadder, SYS_CLOCK_1S and SYS_CLOCK_1MIN begin'],
	['two widths', "PROGRAM Main LD\nRUNG\n  | [ %AIW2 > 3 ] | [ %AID4 > 16#3 ] | COIL %QX0.0 |\nEND_PROGRAM\n", 'error LD730'],
	['an array of timers', with_rung(' t : ARRAY[1..2] OF TON;', '| NO %IX0.0 | TON t[1] PT:=T#1s | COIL %QX0.0 |'), 'error LD730'],
);

sub test_table {
	for my $row (@table) {
		my ($what, $text, $told, $there) = @$row;
		spew("$dir/table.rung", "RUNGBOARD 1\n$text");
		my ($out, $said) = export("$dir/table.rung", 'classicladder', 'table');
		my @changed = grep { !/no task gives/ } $said =~ /^(\S*(?:changed|lost): .*)$/mg;
		$told = quotemeta($told) =~ s/\\\.\\\*/.*/gr;
		if ($told =~ /LD7/) {
			ok(!defined $out && $said =~ /$told/, "$what: refused") or diag($said);
			next;
		}
		ok(defined $out, "$what: written") or diag($said), next;
		if ($told eq quotemeta '-') {
			is("@changed", '', "$what: no message");
		} else {
			like($said, qr/$told/, "$what: message");
		}
		like(slurp($out), $there, "$what: text in the export") if $there;
		taken($what, $out);
	}
}

# ---- an I/O map ----

sub test_io {
	my $map = "BOARD \"Raspberry Pi\"\n"
		. "%IX0.0  gpio  line=GPIO17 pull-up debounce=15ms\n"
		. "%IX0.1  gpio  line=GPIO18 pull-up debounce=15ms\n"
		. "%IX1.0  gpio  line=GPIO4 pull-up active-low debounce=15ms\n"
		. "%QX0.0  gpio  line=GPIO24 safe=0\n%QX0.1  gpio  line=GPIO23 active-low safe=0\n";
	spew("$dir/io.rung", "RUNGBOARD 1\n$body");
	spew("$dir/io.io", $map);
	my ($out, $said) = export("$dir/io.rung", 'classicladder', 'io');
	unlike($said, qr/io\.io/, 'a map that ClassicLadder can hold: no message');
	my ($members) = members(slurp($out));
	is($members->{'ioconf.csv'}, "#VER=1.0\n0,0,2,0,17,2,0,0\n0,8,2,0,4,1,1,0\n"
		. "1,0,2,0,24,1,0,0\n1,1,2,0,23,1,1,0\n", 'its lines');
	like($members->{'general.txt'}, qr/^PERIODIC_INPUTS_REFRESH=5$/m, 'its debouncing');
	taken('an I/O map', $out);
	run($ladder, 'import', $out, '-o', "$dir/back.rung");
	is(slurp("$dir/back.io"), $map, 'an import gives the map again');
	spew("$dir/other.io", "BOARD \"Any\"\n%IX0.0  gpio  line=P9_12\n%IX0.1  gpio  line=GPIO5 debounce=10ms\n"
		. "%QX0.0  gpio  line=GPIO6 open-drain safe=1\n%QX0.1  sim  safe=0\n");
	($out, $said) = export("$dir/io.rung", 'classicladder', 'io', '--io', "$dir/other.io");
	for my $line ('2: changed: %IX0.0: is no pin of a Raspberry', '3: changed: %IX0.1: has a pull-up',
		'3: changed: %IX0.1: must be steady for 12 ms', '4: changed: %QX0.0: is driven to both',
		'4: changed: %QX0.0: has no safe value', '5: changed: %QX0.1: is no pin') {
		like($said, qr/other\.io:\Q$line\E/, "message: $line");
	}
	(undef, $said) = export("$dir/io.rung", 'linuxcnc', 'io');
	like($said, qr/changed: the I\/O map is not exported: LinuxCNC/, 'LinuxCNC: HAL pins instead');
	ok(!defined export("$dir/io.rung", 'classicladder', 'io', '--io', "$dir/none.io"), 'no such map');
}

# ---- what only ClassicLadder understands ----

# Lines of members that only ClassicLadder uses come back after import and export; a hostile
# line in VIEW ends no member.
sub test_kept {
	my $lines = 0;
	for my $project (map { project_of(s/\.script$//r) } sort glob("$ours/*.script")) {
		next if -d $project || $project =~ /z$|numeric/;
		my $name = basename($project);
		my $as = slurp($project) =~ /^MODBUS_MAP_COIL_READ/m ? 'linuxcnc' : 'classicladder';
		run($ladder, 'import', $project, '-o', "$dir/kept.rung");
		my $out = export("$dir/kept.rung", $as, 'kept') // next;
		my $there = slurp($out) =~ tr/\r//dr;
		my ($members) = members(slurp($project) =~ tr/\r//dr);
		for my $member ('modbusioconf.csv', 'config_events.csv', 'project_infos.txt', 'sequential.csv') {
			for my $line (split /\n/, $members->{$member} // '') {
				next if $member eq 'sequential.csv' ? $line !~ /^[NP]\d/ : $line !~ /^[^#;]/;
				next if $line =~ /^PROJECT_NAME=|=$/;
				# A comma ends a field; letters are UTF-8 from the import on.
				$line =~ s/^(N\d+(,\d+){3},.*?),/$1;/ while $line =~ /^N\d+(,\d+){3},.*?,/;
				next if $line =~ /[^ -~]/;
				$lines++;
				like($there, qr/^\Q$line\E$/m, "$name: $member keeps $line");
			}
		}
	}
	cmp_ok($lines, '>', 5, 'lines that are kept');
	spew("$dir/kept.rung", "RUNGBOARD 1\n${body}VIEW\n  classicladder modbusioconf.csv _/FILE-modbusioconf.csv\n"
		. "  classicladder modbusioconf.csv S0,1,0,one\n  classicladder rung_0.csv #VER=9.9\n"
		. "  classicladder sequential.csv N0,99,1,1,nowhere\n  classicladder project_infos.txt PARAM_AUTHOR=Me\n"
		. "  classicladder\n  linuxcnc config_events.csv 1\nEND_VIEW\n");
	my $out = export("$dir/kept.rung", 'classicladder', 'kept');
	my ($members, $order) = members(slurp($out));
	is($members->{'modbusioconf.csv'}, "S0,1,0,one\n", 'a line that would end a member is left out');
	like($members->{'project_infos.txt'}, qr/^PARAM_AUTHOR=Me$/m, 'an author');
	spew("$dir/about.rung", "RUNGBOARD 1\nPROJECT \"P\"\nAUTHOR \"You\"\nDESCRIPTION \"one\$Ntwo\"\n"
		. "${body}VIEW\n  classicladder project_infos.txt PARAM_AUTHOR=Me\nEND_VIEW\n");
	my ($exported) = export("$dir/about.rung", 'classicladder', 'about');
	my ($parts) = members(slurp($exported));
	my $about = $parts->{'project_infos.txt'};
	like($about, qr/^PARAM_AUTHOR=You$/m, 'the author of the project wins over a line that was kept');
	unlike($about, qr/=Me/, 'and is written once');
	like($about, qr/^PARAM_COMMENT=one\\ntwo$/m, 'a line break of the description');
	unlike(slurp($out), qr/nowhere|9\.9/, 'a note of no page and a rung are left out');
	taken('kept lines', $out);
}

test_ours();
test_samples() if $ENV{SAMPLES};
test_random();
test_numeric();
test_random_ladders();
test_ladders();
test_table();
test_io();
test_kept();
done_testing();
