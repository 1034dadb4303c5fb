#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# convert.t - what `ladder export --as` st, fbd, ld and il write does the same as the program that it comes
# from: all samples with their scenarios, all golden cases that have a trace, and random programs.
#
#   convert.t [--seed N [LANGUAGE]]   one random program; both texts and the first difference are printed
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname basename);
use File::Copy qw(copy);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $tests = abs_path(dirname(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $random = "$build/tests/bin/differential";
my $count = $ENV{CONVERT_COUNT} // 200;
my $dir = tempdir(CLEANUP => 1);

# A trace without the variables that conversion adds, and without places of the program's text.
sub plain {
	my ($trace) = @_;
	$trace =~ s/ Rung\d+(?:_\d+|_edge(?:_\d+)?\.(?:CLK|Q))?=\S+//g;
	$trace =~ s/ (?:\w+\.)?\w+_(?:rises|falls)(?:_\d+)?\.(?:CLK|Q|N\d+)=\d//g;
	$trace =~ s/ (?:[\w.\[\]]+\.)?(?:Rung\d|Net\d|_[A-Z]\d|EDGE\d+\.E\d)\w*(?:\.N\d+)?=\S+//g;
	$trace =~ s/ _[A-Z]\d\w*(?:\[\d+\]|\.\w+)+=\S+//g; # parts of a copy
	$trace =~ s/^# (STOP|FAULT)[^\n]*\n/# $1\n/mg;
	return $trace;
}

sub trace_of {
	my ($file, $stimulus) = @_;
	return plain(scalar `cd $dir && $ladder trace '$file' '$stimulus' 2>/dev/null`);
}

sub first_difference {
	my ($one, $two) = @_;
	my @a = split /\n/, $one;
	my @b = split /\n/, $two;
	for my $i (0 .. ($#a > $#b ? $#a : $#b)) {
		return "was: " . ($a[$i] // '-') . "\nis:  " . ($b[$i] // '-') if ($a[$i] // '') ne ($b[$i] // '');
	}
	return '';
}

# Without wires: a ladder has variables of other names.
sub without_wires {
	my ($trace) = @_;
	$trace =~ s/ (?:[\w.\[\]]+\.)?\w+\.[NP]\d+(?:[.\[]\S*)?=\S+//g;
	return $trace;
}

# Of a chart that becomes lists: without what only one of both has, as steps lose their names.
sub common {
	my @traces = @_;
	my %has;
	for my $trace (@traces) {
		$has{$_}++ for ($trace =~ /^(1 t=.*)$/m ? $1 : '') =~ / ([\w.\[\],%]+)=/g;
	}
	return map { s/ ([\w.\[\],%]+)=\S+/($has{$1} \/\/ 0) == 2 ? $& : ''/ger =~ s/^#.*\n//mgr } @traces;
}

# Is a file of this kind converted? Then its text is in the second file.
sub converts {
	my ($from, $as, $to) = @_;
	my $said = `cd $dir && $ladder export --as $as '$from' -o '$to' 2>&1`;
	return ($? == 0, $said);
}

# As networks and back.
sub back {
	my ($from, $to) = @_;
	my ($good, $said) = converts($from, 'fbd', 'between.rung');
	return $good ? converts('between.rung', 'ld', $to) : (0, $said);
}

# Samples. Ladders of samples can all be converted.
sub sample {
	my ($sample, $as) = @_;
	my $name = basename($sample);
	copy($sample, "$dir/$name");
	my ($good, $said) = converts($name, $as, "$as-$name");
	ok($good, "$name: its ladders become $as") or diag($said), return;
	my $left = $as eq 'ld' ? qr/^PROGRAM \w+ FBD/m : qr/^PROGRAM \w+ LD/m;
	unlike(slurp("$dir/$as-$name"), $left, "$name: nothing is left that becomes $as");
	(my $scenario = $sample) =~ s/rung$/scn/;
	# Steps of a chart have no names in Structured Text.
	return if !-e $scenario || slurp($sample) =~ /^PROGRAM \w+ SFC/m;
	copy($scenario, "$dir/$as-" . basename($scenario));
	(my $plant = $sample) =~ s/rung$/plant.rung/;
	copy($plant, "$dir/$_" . basename($plant)) for -e $plant ? ('', "$as-") : ();
	my $tap = `cd $dir && $ladder test '$as-$name' 2>&1`;
	ok($? == 0 && $tap =~ /^ok/m, "$name: its scenarios hold as $as") or diag($tap);
}

for my $sample (sort(glob("$tests/../ladders/*.rung"), glob("$tests/../ladders/*/*.rung"))) {
	next if slurp($sample) =~ /^(?:INCLUDE|USES)/m || $sample =~ /plant\.rung$/;
	my $ladders = slurp($sample) =~ /^(?:PROGRAM|FUNCTION|FUNCTION_BLOCK)\b.* LD$/m;
	my $networks = slurp($sample) =~ /^(?:PROGRAM|FUNCTION|FUNCTION_BLOCK)\b.* FBD$/m;
	sample($sample, $_) for ($ladders || $networks ? 'st' : ()), ($ladders ? 'fbd' : ()), ($networks ? 'ld' : ());
}

# Golden cases with a trace.
my %done = (st => 0, fbd => 0, ld => 0, back => 0, il => 0);
for my $case (sort glob "$tests/golden/*") {
	next unless -e "$case/main.rung" && -e "$case/expected.trace";
	my $name = basename($case);
	next if -e "$case/stimulus" && slurp("$case/stimulus") =~ /\.N\d/; # a wire has another name in a list
	system "cp $case/* $dir/";
	my %was; # its traces, by their stimulus
	for my $as ('st', 'fbd', 'ld', 'back', 'il') {
		next if $as ne 'il' && slurp("$case/main.rung") =~ /^PROGRAM \w+ SFC/m; # its steps lose their names
		next if $as eq 'st' && slurp("$case/main.rung") !~ /^\w+ .* ?(?:LD|FBD)$/m;
		next if ($as eq 'fbd' || $as eq 'back') && slurp("$case/main.rung") !~ /^\w+ .* ?LD$/m;
		next if $as eq 'ld' && slurp("$case/main.rung") !~ /^\w+ .* ?FBD$/m;
		my ($good, $said) = $as ne 'back' ? converts('main.rung', $as, "$as.rung") :
			-e "$dir/fbd.rung" ? converts('fbd.rung', 'ld', 'back.rung') : back('main.rung', 'back.rung');
		if (!$good) {
			ok($said =~ m{error LD(?:78|460)}, "$name: a reason why it does not become $as") or diag(join "\n", grep { !m{warning} } split m{\n}, $said);
			next;
		}
		my $chart = slurp("$case/main.rung") =~ /^\w+ \w+ SFC/m;
		spew("$dir/stimulus", slurp("$dir/stimulus") =~ s/^\@print.*\n//mgr) if $chart && -e "$dir/stimulus";
		my $was = $was{slurp("$dir/stimulus") // ''} //= trace_of('main.rung', 'stimulus');
		my $is = trace_of("$as.rung", 'stimulus');
		($was, $is) = common($was, $is) if $chart;
		($was, $is) = (without_wires($was), without_wires($is)) if $as eq 'ld' || $as eq 'back';
		$done{$as}++;
		ok($is eq $was && $was ne q(), "$name as $as") or diag(first_difference($was, $is));
	}
	unlink glob "$dir/*.rung";
}
ok($done{st} > 100 && $done{fbd} > 100 && $done{back} > 100 && $done{ld} && $done{il} > 150,
   'most golden cases are converted: ' . join ', ', map { "$done{$_} $_" } sort keys %done);

# Charts become ladders, and these Structured Text: both texts do the same.
for my $sample (qw(sequence-s0-s8 press-two-hand traffic-crossing)) {
	copy("$tests/../ladders/$sample.rung", "$dir/chart.rung");
	converts('chart.rung', 'ld', 'chart-ld.rung');
	my ($good, $said) = converts('chart.rung', 'st', 'chart-st.rung');
	ok($good, "$sample: its charts become Structured Text") or diag($said), next;
	srand 7;
	spew("$dir/s", '@print %QB0 %QB1' . "\n" . join '', map { sprintf "%%IX0.%d=%d\n", rand 8, rand 2 } 1 .. 200);
	my $was = trace_of('chart-ld.rung', 's');
	ok($was =~ /^200 t=/m && $was eq trace_of('chart-st.rung', 's'), "$sample: both do the same");
}

# One chart alone: the other one stays.
{
	my $chart = "PROGRAM %s SFC\n  INITIAL_STEP %s_off:\n  END_STEP\n  STEP %s_on:\n    %s(N);\n  END_STEP\n" .
		"  TRANSITION FROM %s_off TO %s_on := %s; END_TRANSITION\n  TRANSITION FROM %s_on TO %s_off := NOT %s; END_TRANSITION\nEND_PROGRAM\n";
	spew("$dir/two.rung", "RUNGBOARD 1\n" . join '', map { my ($name, $in, $out) = @$_; sprintf $chart, ($name) x 3, $out, ($name) x 2, $in, ($name) x 2, $in }
	     ['Press', '%IX0.0', '%QX0.0'], ['Feed', '%IX0.1', '%QX0.1']);
	srand 5;
	spew("$dir/s", '@print %QB0' . "\n" . join '', map { sprintf "%%IX0.%d=%d\n", rand 2, rand 2 } 1 .. 60);
	my $was = trace_of('two.rung', 's');
	for my $as (qw(ld st fbd il)) {
		my $said = `cd $dir && $ladder export --as $as two.rung Press -o one.rung 2>&1`;
		is($?, 0, "one chart becomes $as") or diag($said), next;
		my $text = slurp("$dir/one.rung");
		ok($text =~ /^PROGRAM Feed SFC/m && $text !~ /^PROGRAM Press SFC/m, "$as: the other chart stays");
		my ($word) = uc $as;
		unlike($text, qr/^\w+ \w+ (?!$word|SFC)[A-Z]+$/m, "$as: nothing is left in between");
		ok($was =~ /^60 t=/m && $was eq trace_of('one.rung', 's'), "$as: it does the same");
	}
	my $said;
	spew("$dir/words.rung", "RUNGBOARD 1\n\nPROGRAM Main ST\n  %QX0.0 := TRUE;\nEND_PROGRAM\n");
	for my $as (qw(ld fbd)) {
		$said = `cd $dir && $ladder export --as $as words.rung Main 2>&1`;
		ok($? && $said =~ /^words.rung:3: error LD784/m, "Structured Text does not become $as");
	}
}

# An edge is computed in each scan. So it is converted behind a value that always is one, and not behind one that can fail.
for (['MAX(n, 3) > 4 AND R_EDGE(Go)', 1], ['(MAX(n, 3) > 4) AND R_EDGE(Go)', 1], ['R_EDGE(Go) AND DIV(n, k) > 4', 1], ['NOT (R_EDGE(Go) OR n > k)', 1],
     ['DIV(n, k) > 4 AND R_EDGE(Go)', 0], ['(DIV(n, k) > 4) AND R_EDGE(Go)', 0], ['ABS(n) > 4 AND R_EDGE(Go)', 0], ['n / k > 4 AND R_EDGE(Go)', 0]) {
	my ($value, $sure) = @$_;
	spew("$dir/edge.rung", "RUNGBOARD 1\nVAR\n  Go AT %IX0.0 : BOOL;\n  n AT %IW2 : INT;\n  k AT %IW4 : INT;\n  q AT %QX0.0 : BOOL;\nEND_VAR\n" .
	     "PROGRAM Main FBD\nNETWORK\n  q := $value\nEND_PROGRAM\n");
	my ($good, $said) = converts('edge.rung', 'st', 'edge-st.rung');
	ok($sure ? $good : !$good && $said =~ /^edge.rung:10: error LD786/m, "$value: " . ($sure ? 'converted' : 'refused')) or diag($said);
}

# Several coils of one condition are one rung, and stay one as networks and back.
{
	spew("$dir/coils.rung", <<'END');
RUNGBOARD 1

VAR
  A  AT %IX0.0 : BOOL;
  B  AT %IX0.1 : BOOL;
  X  AT %QX0.0 : BOOL;
  Y  AT %QX0.1 : BOOL;
  Z  AT %QX0.2 : BOOL;
  T1 : TON;
  T2 : TON;
  N  : INT;
END_VAR

(* above the program *)
PROGRAM Main LD
// above the rung
RUNG "two coils"
  | NO A | NC B | COIL X |
  |      |     ^| S Y    |
RUNG Two "three, behind a branch"
  | NO A  | NO B | COIL X |
  | NO X ^|     ^| S Y    |
  |       |     ^| R Z    |
RUNG "a branch that is the last"
  | NO A  | COIL X |
  | NO B ^| COIL Y |
RUNG "behind a timer"
  | NO A | TON T1 PT:=T#1s | COIL X |
  |      |                ^| COIL Y |
RUNG "contacts behind a timer"
  | NO A  | TON T2 PT:=T#1s | NO B       | NC A | COIL X |
  | NO B ^|                ^| [ N > 5 ] ^|
RUNG
  | NC B | JMP Two |
(* at the end *)
END_PROGRAM
END
	my ($good, $said) = back('coils.rung', 'again.rung');
	ok($good, 'several coils become networks and a ladder again') or diag($said);
	system "cd $dir && $ladder fmt again.rung";
	is(slurp("$dir/again.rung"), slurp("$dir/coils.rung"), 'which is the same');
}

# NOT in front of an output of a block is a coil in its rung, or a contact behind it: no Structured Text.
{
	spew("$dir/inverse.rung", <<'END');
RUNGBOARD 1

VAR
  A AT %IX0.0 : BOOL;
  B AT %IX0.1 : BOOL;
  X AT %QX0.0 : BOOL;
  Y AT %QX0.1 : BOOL;
  Z AT %QX0.2 : BOOL;
  M : TIME;
  N : INT;
  T : TON;
  C : CTUD;
END_VAR

PROGRAM Main FBD
NETWORK
  T(IN := A, PT := T#20ms, NOT Q => X, ET => M)
  Y := NOT T.Q
NETWORK
  C(CU := A, CD := B, R := A AND B, PV := 1, NOT QU => X, NOT QD => Z, CV => N)
NETWORK
  T(IN := X, PT := T#20ms, NOT Q => w)
  X := w OR Z
END_PROGRAM
END
	my ($good, $said) = converts('inverse.rung', 'ld', 'inverse-ld.rung');
	ok($good, 'inverted outputs become a ladder') or diag($said);
	my $rungs = slurp("$dir/inverse-ld.rung") =~ s/ +/ /gr;
	like($rungs, qr/\| NO A \| TON T PT:=T#20ms ET=>M \| COILNOT X \|\n \| \| \^\| COILNOT Y \|\n/, 'as negated coils behind their block');
	like($rungs, qr/^ \| NC C\.QU \| COIL X \|\nRUNG\n \| NC C\.QD \| COIL Z \|\n/m, 'and as contacts, of outputs that are no power');
	unlike($rungs, qr/EXECUTE/, 'without Structured Text');
	srand 9;
	spew("$dir/s", "\@print X Y Z M N T.Q C.CV\n" . join '', map { sprintf "%%IX0.%d=%d\n", rand 2, rand 2 } 1 .. 60);
	my $was = trace_of('inverse.rung', 's');
	ok($was =~ /^60 t=/m && $was =~ /X=0.*X=1/s && $was eq trace_of('inverse-ld.rung', 's'), 'and it does the same');
}

# Comments and titles come along into lists, in their order: of networks, of ladders with boxes, of Structured Text.
{
	spew("$dir/said.rung", <<'END');
RUNGBOARD 1

VAR
  A AT %IX0.0 : BOOL;
  X AT %QX0.0 : BOOL;
  N AT %QW2   : INT;
END_VAR

// c00
PROGRAM Main FBD
// c01
(* c02
   c03 *)
NETWORK "c04"
  X := A // c05
  // c06
  N := ADD(N, (* c07 *) 1)
NETWORK OFF Away "c08"
  N := 7 // c09
NETWORK
  JMP Away IF X
  // c10
END_PROGRAM

PROGRAM Rungs LD
// c11
RUNG "c12"
  | NO A (* c13 *) | COIL X |
RUNG
  | NO A | EXECUTE E | COIL X |
  EXECUTE E:
    // c14
    N := 3; // c15
    N := N + 1; // c16
  END_EXECUTE
// c17
RUNG OFF "c18"
  | NO X | COIL X |
END_PROGRAM

PROGRAM Words ST
  // c19
  IF A THEN
    // c20
    N := 1; // c21
  ELSE // c22
    FOR N := 1 TO (* c23 *) 3 DO
      // c24
      X := NOT X;
    END_FOR;
  END_IF;
  // c25
END_PROGRAM
END
	my ($good, $said) = converts('said.rung', 'il', 'said-il.rung');
	ok($good, 'a project with comments becomes lists') or diag($said);
	my $text = slurp("$dir/said-il.rung");
	is(join(' ', $text =~ /\bc(\d\d)\b/g), join(' ', map { sprintf '%02d', $_ } 0 .. 25), 'all comments are there, once and in their order') or diag($text);
	like($text, qr|  ST    X // c05\n// c06\n|, 'one behind a line stands behind its last instruction');
	like($text, qr|  ST    N // c15\n(?: .*\n)*  .*N\)? // c16\n_|, 'also inside of a box');
	system "cd $dir && $ladder fmt said-il.rung 2>/dev/null";
	is(slurp("$dir/said-il.rung"), $text, 'the list is written as fmt writes it');
}

# More contacts than a rung has columns, also in parentheses: before a block, and behind it.
for my $nested (0, 1) {
	my $bit = sub { sprintf '%%IX%d.%d', int $_[0] / 8, $_[0] % 8 };
	my $all = sub { my ($from, $to) = @_; join($nested ? ' AND (' : ' AND ', map { $bit->($_) } $from .. $to) . ')' x ($nested * ($to - $from)) };
	spew("$dir/wide.rung", "RUNGBOARD 1\n\nVAR\n  X AT %QX0.0 : BOOL;\n  T1 : TON;\nEND_VAR\n\nPROGRAM Main FBD\nNETWORK\n  T1(IN := " . $all->(0, 39) .
		', PT := T#20ms)' . "\n  X := T1.Q AND " . ($nested ? '(' . $all->(40, 69) . ')' : $all->(40, 69)) . "\nEND_PROGRAM\n");
	my ($good, $said) = converts('wide.rung', 'ld', 'wide-ld.rung');
	ok($good, "40 contacts, a block, 30 contacts become rungs, nested: $nested") or diag($said), next;
	srand 3;
	spew("$dir/s", "\@print X T1.Q\n" . join('', map { "%IX" . int($_ / 8) . '.' . $_ % 8 . "=1 " } 0 .. 69) . "\n.\n.\n.\n" .
		join '', map { my $one = $bit->(rand 70); "$one=0\n$one=1\n.\n.\n" } 1 .. 40);
	my $was = trace_of('wide.rung', 's');
	ok($was =~ /X=1 T1.Q=1/ && $was =~ /X=0 T1.Q=1/ && $was eq trace_of('wide-ld.rung', 's'), 'which do the same');
}

# Many contacts behind a block that read what it computes stand behind it.
{
	spew("$dir/behind.rung", "RUNGBOARD 1\n\nVAR\n  A AT %IX0.0 : BOOL;\n  X AT %QX0.0 : BOOL;\n  C : CTU;\nEND_VAR\n\nPROGRAM Main FBD\nNETWORK\n" .
		"  C(CU := A, PV := 1)\n  X := C.Q AND C.CV = 1" . ' AND A' x 30 . "\nEND_PROGRAM\n");
	my ($good, $said) = converts('behind.rung', 'ld', 'behind-ld.rung');
	ok($good, 'contacts that read a block become rungs') or diag($said);
	spew("$dir/s", "\@print X\n" . "A=1\nA=0\n" x 3);
	my $was = trace_of('behind.rung', 's');
	ok($was =~ /^1 .*X=1/m && $was eq trace_of('behind-ld.rung', 's'), 'behind the block') or diag($was);
}

# What a chart's ladders cannot say in another language has the place in the chart.
{
	spew("$dir/place.rung", <<'END');
RUNGBOARD 1

VAR
  A AT %IX0.0 : BOOL;
  Q AT %QX0.0 : BOOL;
END_VAR

PROGRAM Main SFC
  INITIAL_STEP S0:
    Q(N);
  END_STEP

  STEP S1:
    Act(N);
  END_STEP

  TRANSITION FROM S0 TO S1:
    RUNG
      | NO A | COIL TRANSITION |
  END_TRANSITION

  TRANSITION FROM S1 TO S0 := NOT A; END_TRANSITION

  ACTION Act:
    RUNG
      | NO A | COIL Q |
    RUNG
      | NC A | STOP |
  END_ACTION
END_PROGRAM
END
	my $said = `cd $dir && $ladder export --as st place.rung 2>&1`;
	like($said, qr/^place\.rung:27: rung \d+ \(1,2\): error LD780: "STOP"/m, 'st: a rung of an action');
	$said = `cd $dir && $ladder export --as fbd place.rung 2>&1`;
	like($said, qr/^  STOP IF NOT A$/m, 'fbd has STOP');
}

# CASE and FOR of a box become jumps, if it is plain what they look at.
spew("$dir/case.rung", <<'END');
RUNGBOARD 1
TYPE
  Color : (Red, Green, Blue);
END_TYPE
VAR
  Go AT %IX0.0 : BOOL;
  Raw AT %IW2 : UINT;
  Q AT %QX0.0 : BOOL;
  n : INT;
  m : INT;
  N2 : INT := 5;
  u : USINT;
  c : Color;
  sum : DINT;
END_VAR
PROGRAM Main LD
VAR i : INT; t : ARRAY[1..10] OF INT; END_VAR
RUNG
  | NO Go | EXECUTE A | COIL Q |
  EXECUTE A:
    CASE Raw OF
      1, 3:
        n := n + 1;
      5..9, 16#FFFD, 20:
        n := n + 2;
        CASE c OF
          Red:
            c := Green;
          Green:
            c := Blue;
          ELSE
            c := Red;
        END_CASE;
      ELSE
        n := 0;
    END_CASE;
    FOR i := 1 TO N2 DO
      IF i = 3 THEN
        CONTINUE;
      END_IF;
      t[i] := t[i] + n;
      IF n > 30 THEN
        EXIT;
      END_IF;
    END_FOR;
    FOR i := 3 TO -1 BY -2 DO
      sum := sum + i;
    END_FOR;
    FOR u := 250 TO 255 BY 2 DO
      sum := sum + 1;
    END_FOR;
    m := t[2];
    N2 := 10 - N2;
  END_EXECUTE
END_PROGRAM
END
spew("$dir/s", "\@print n m sum u Main.i c Q N2 SYS_ERRORS\nGo=1\n" . join('', map { "%IW2=$_\n" } 1, 3, 4, 5, 6, 9, 20) . ". x30\n%IW2=65533\n%IW2=77\nGo=0\n.\n");
{
	my ($good, $said) = converts('case.rung', 'fbd', 'case-fbd.rung');
	ok($good, 'CASE and FOR become networks') or diag($said);
	my $was = trace_of('case.rung', 's');
	ok($was =~ /^40 t=/m && $was eq trace_of('case-fbd.rung', 's'), 'and do the same') or diag(first_difference($was, trace_of('case-fbd.rung', 's')));
	for (['CASE Raw OF', 'CASE Raw + 1 OF', 'CASE'], ['FOR i := 1 TO N2 DO', 'FOR i := 1 TO N2 * 2 DO', 'FOR'], ['sum := sum + 1;', 'sum := sum + 1; N2 := 3;', ''],
	     ['t[i] := t[i] + n;', 't[i] := t[i] + n; N2 := N2 - 1;', 'FOR'], ['FOR i := 1 TO N2 DO', 'FOR i := 1 TO i DO', 'FOR'],
	     ['VAR i : INT;', 'VAR i : INT(-3..10);', 'FOR']) {
		my ($old, $new, $word) = @$_;
		spew("$dir/odd.rung", slurp("$dir/case.rung") =~ s/\Q$old\E/$new/r);
		($good, $said) = converts('odd.rung', 'fbd', 'odd-fbd.rung');
		$word ? like($said, qr/^odd\.rung:\d+: rung 1 \(1,2\): error LD780: "$word"/m, "$new is refused") : ok($good, "$new is not") || diag($said);
	}
}

# The memory of a name may have other names: a value is as it was where its line stands, and a bound where its FOR does.
spew("$dir/alias.rung", <<'END');
RUNGBOARD 1
VAR
  B AT %IX0.0 : BOOL;
  N AT %IW2 : INT;
  A AT %MX0.0 : BOOL;
  Wd AT %MW0 : WORD;
  k : BOOL;
  p : REF_TO BOOL := REF(k);
  r : REFERENCE TO BOOL;
  l : ARRAY[0..1] OF BOOL;
  One : Own;
  Q0 AT %QX0.0 : BOOL;
  Q1 AT %QX0.1 : BOOL;
  Q2 AT %QX0.2 : BOOL;
  Q3 AT %QX0.3 : BOOL;
  Q4 AT %QX0.4 : BOOL;
END_VAR
FUNCTION_BLOCK Own FBD
VAR_IN_OUT
  One : BOOL;
  Two : BOOL;
  List : ARRAY[0..1] OF BOOL;
END_VAR
VAR_INPUT
  On : BOOL;
END_VAR
VAR_OUTPUT
  Out, More : BOOL;
END_VAR
NETWORK
  Was := One AND On
  Two := NOT One
  Out := Was
NETWORK
  Was := One AND On
  List[0] := NOT One
  More := Was
END_FUNCTION_BLOCK
PROGRAM Main FBD
NETWORK
  r REF= k
NETWORK
  V := A AND B
  Wd := INT_TO_WORD(N)
  Q0 := V
NETWORK
  V := k AND B
  p^ := N > 2
  Q1 := V
NETWORK
  V := k AND B
  r := N > 3
  Q2 := V
NETWORK
  V := r AND B
  k := N > 4
  Q3 := V
NETWORK
  V := p^ AND B
  k := N > 5
  Q4 := V
NETWORK
  One(One := l[0], Two := l[0], List := l, On := B)
END_PROGRAM
END
{
	srand 11;
	spew("$dir/s", '@print %QB0 k Wd l[0] One.Out One.More' . "\n" . join '', map { sprintf "B=%d N=%d\n", rand() < 0.8, rand 8 } 1 .. 80);
	my ($good, $said) = converts('alias.rung', 'ld', 'alias-ld.rung');
	ok($good, 'networks with pointers, references and addresses become ladders') or diag($said);
	my ($was, $is) = (trace_of('alias.rung', 's'), trace_of('alias-ld.rung', 's'));
	ok($was =~ /^80 t=/m && $was eq $is, 'and do the same') or diag(first_difference($was, $is));
	for (['m', 'b := 2;'], ['m', '%MB4 := 2;'], ['k', 'p^ := 2;'], ['k', 'r := 2;'], ['r', 'k := 2;'], ['k', 'o := 2;', 1], ['k', 'b := 2;', 1], ['m', 'q := 2;', 1]) {
		my ($bound, $line, $good_one) = @$_;
		spew("$dir/bound.rung", "RUNGBOARD 1\nVAR\n  Go AT %IX0.0 : BOOL;\n  m AT %MW4 : INT := 5;\n  b AT %MB4 : BYTE;\n  n, o, q, i : INT;\n  k : INT := 5;\n  p : REF_TO INT := REF(k);\n" .
		     "  r : REFERENCE TO INT;\nEND_VAR\nPROGRAM Main LD\nRUNG\n  | NO Go | EXECUTE A |\n  EXECUTE A:\n    r REF= k;\n    FOR i := 1 TO $bound DO\n      $line\n      n := n + 1;\n    END_FOR;\n" .
		     "  END_EXECUTE\nEND_PROGRAM\n");
		($good, $said) = converts('bound.rung', 'fbd', 'bound-fbd.rung');
		ok($good_one ? $good : $said =~ /^bound\.rung:\d+: rung 1 \(1,2\): error LD780: "FOR"/m, "a FOR to $bound around $line") or diag($said);
	}
}

# A BOOL wire that one line reads is no variable: its contacts stand in that line's rung.
spew("$dir/join.rung", <<'END');
RUNGBOARD 1

VAR
  A AT %IX0.0 : BOOL;
  B AT %IX0.1 : BOOL;
  C AT %IX0.2 : BOOL;
  Q AT %QX0.0 : BOOL;
  N AT %IW2 : INT;
  Delay : TON;
END_VAR

PROGRAM Main FBD
NETWORK
  Run := A OR B
  Low := LT(IN1 := N, IN2 := 20)
  Q := Run AND NOT C AND Low
NETWORK
  Both := A AND B
  Delay(IN := Both OR C, PT := T#20ms)
NETWORK
  Was := A AND Q
  Q := C
  Q := NOT Was
END_PROGRAM
END
{
	converts('join.rung', 'ld', 'join-ld.rung');
	is(slurp("$dir/join-ld.rung") =~ s/.*?(?=^RUNG\n)//msr, <<'END', 'series and parallel contacts, the coil at the end');
RUNG
  | NO A  | NC C | [ LT(IN1 := N, IN2 := 20) ] | COIL Q |
  | NO B ^|
RUNG
  | NO A | NO B | TON Delay PT:=T#20ms |
  | NO C | --- ^|
RUNG
  | NO A | NO Q | COIL Was |
RUNG
  | NO C | COIL Q |
RUNG
  | NC Was | COIL Q |
END_PROGRAM
END
}

# Networks: their wires have other names, so only the variables of both are compared.
sub network {
	my ($number) = @_;
	my (@bit, @int);
	my $bit = sub { ('%IX0.' . int rand 8, map({ "b$_" } 0 .. 3), @bit, @bit)[rand 12 + 2 * @bit] // 'c1' };
	my $int = sub { ('n' . int rand 3, @int, int rand 9)[rand 2 + @int] };
	my $text = 'NETWORK ' . (rand() < 0.1 ? 'OFF ' : '') . "L$number\n";
	for my $line (1 .. 2 + rand 6) {
		my $wire = "w$line" . '_' x ($number % 3);
		my $kind = int rand 20;
		my ($p, $q, $m, $n) = ($bit->(), $bit->(), $int->(), $int->());
		if ($kind == 0) { $text .= "  $wire := $p AND NOT $q\n"; push @bit, $wire }
		elsif ($kind == 1) { $text .= "  $wire := ADD($m, n1)\n"; push @int, $wire }
		elsif ($kind == 2) { $text .= "  b" . int(rand 4) . ' ' . (rand() < 0.5 ? 'S' : 'R') . "= $p XOR $q\n" }
		elsif ($kind == 3) { $text .= "  $wire := " . (rand() < 0.5 ? 'R' : 'F') . "_EDGE($p OR $q)\n"; push @bit, $wire }
		elsif ($kind == 4) { $text .= "  $wire := ADD(PREVIOUS($wire), SEL($p, n0, $m))\n"; push @int, $wire }
		elsif ($kind == 5) { $text .= "  $wire := SUB(EN := $p, IN1 := n2, IN2 := $n, ENO => e$wire)\n"; push @int, $wire; push @bit, "e$wire" }
		elsif ($kind == 6) { $text .= "  n" . int(rand 3) . " := MUL($m, n0) / $n\n" }
		elsif ($kind == 7) { $text .= "  t" . int(rand 2) . "(IN := $p, PT := T#20ms)\n  b" . int(rand 4) . " := t0.Q AND $q\n" }
		elsif ($kind == 8) { $text .= "  b" . int(rand 4) . " := n0 > $m OR R_EDGE($q)\n" }
		elsif ($kind == 9) { $text .= "  $wire := AND($p, NOT $q, OR(b0, $p)) XOR b1\n"; push @bit, $wire }
		elsif ($kind == 10) { $text .= "  c0(CU := $p OR b2, R := " . ('b3', "$q AND NOT b0", "n0 > $m", 'R_EDGE(b1 OR b0)')[rand 4] . ", PV := 3)\n  b" . int(rand 4) . " := c0.Q\n" }
		elsif ($kind == 11) { $text .= "  n" . int(rand 3) . " := ADD(EN := $p AND $q, IN1 := n1, IN2 := " . ($m =~ /^\d/ ? $m : 'n2') . ", ENO => b" . int(rand 4) . ")\n" }
		elsif ($kind == 12) { $text .= "  b" . int(rand 4) . " := " . ('NOT', '')[rand 2] . " ($p AND ($q OR NOT (b2 XOR F_EDGE($q)))) OR " . ('TRUE', 'FALSE', "$p")[rand 3] . "\n" }
		elsif ($kind == 13) { $text .= '  a[' . ($m =~ /^\d/ ? $m % 4 : $m) . '] ' . ('S=', 'R=', ':=')[rand 3] . " $p OR b1\n  $wire := a[n0] AND $q\n"; push @bit, $wire }
		elsif ($kind == 14) { $text .= "  w0 := (w0 XOR INT_TO_WORD($m)) AND 16#0F0F\n  b" . int(rand 4) . " := (w0 AND 4) = 4 AND $p\n" }
		elsif ($kind == 15) { $text .= "  b" . int(rand 4) . ' ' . ('S', 'R')[rand 2] . "= 8 / n0 > $n AND $p\n" }
		elsif ($kind == 16) { $text .= "  $wire := SEL(R_EDGE($p AND $q), $m, n1 + 1)\n"; push @int, $wire }
		elsif ($kind == 17) { $text .= "  " . ('More()', "r0(S1 := $p, R := $q)\n  b1 S= r0.Q1", "t1(EN := $p, IN := $q, PT := T#30ms)", "x0($p, n2)\n  n1 := x0.Out")[rand 4] . "\n" }
		elsif ($kind == 18) { $text .= "  $wire := PREVIOUS($wire) XOR $p\n"; push @bit, $wire }
		else { $text .= rand() < 0.7 ? '  JMP L' . ($number + 1) . " IF $p\n" : "  RETURN IF $p AND $q AND c1\n" }
	}
	return $text;
}

my ($networks, $unequal, %drawn) = (0, '');
for my $seed (1 .. ($ENV{CONVERT_COUNT} // 200)) {
	srand $seed;
	my $body = join '', map { network($_) } 1 .. 5;
	spew("$dir/n.rung", "RUNGBOARD 1\n\nVAR\n" . join('', map { "  b$_ : BOOL;\n" } 0 .. 3) .
	     join('', map { "  n$_ : INT := $_;\n" } 0 .. 2) . "  t0 : TON;\n  t1 : TON;\n  c0 : CTU;\n  r0 : SR;\n  x0 : Own;\n" .
	     "  a : ARRAY[0..3] OF BOOL;\n  w0 : WORD;\n  c1 : BOOL := TRUE;\nEND_VAR\n\n" .
	     "SUBROUTINE More FBD\nNETWORK\n  n2 := n2 + 1\nEND_SUBROUTINE\n\n" .
	     "FUNCTION_BLOCK Own FBD\nVAR_INPUT\n  Up : BOOL;\n  By : INT;\nEND_VAR\nVAR_OUTPUT\n  Out : INT;\nEND_VAR\n" .
	     "NETWORK\n  Rose := R_EDGE(Up)\n  Out := ADD(EN := Rose OR By > 3, IN1 := Out, IN2 := By)\nEND_FUNCTION_BLOCK\n\n" .
	     "PROGRAM Main FBD\n${body}NETWORK L6\n  c1 := NOT %IX0.0\nEND_PROGRAM\n");
	next if system("cd $dir && $ladder check n.rung >/dev/null 2>&1");
	spew("$dir/s", '@print ' . join(' ', map({ "b$_" } 0 .. 3), 'n0 n1 n2 t0.ET t1.Q c0.CV r0.Q1 x0.Out a[0] a[3] w0 c1 SYS_ERRORS') . "\n" .
	     join '', map { sprintf "%%IX0.%d=%d %%IX0.%d=%d\n", rand 8, rand 2, rand 8, rand 2 } 1 .. 20);
	my $was = trace_of('n.rung', 's');
	$networks++;
	for my $as ('st', 'ld') {
		my ($good, $said) = converts('n.rung', $as, 'm.rung');
		next if !$good && $said =~ /LD786/;
		my $is = $good ? trace_of('m.rung', 's') : $said;
		$unequal .= "seed $seed: $as: " . first_difference($was, $is) . "\n" if $was ne $is || $was !~ /^20 t=/m;
		$drawn{$as}++;
	}
}
is($unequal, '', "$networks random programs of networks do the same: $drawn{st} as st, $drawn{ld} as ld");
ok($networks > ($ENV{CONVERT_COUNT} // 200) / 4 && $drawn{st} > $networks / 4 && $drawn{ld} > $networks / 2,
   'many random networks are good');

# Random programs.
sub names_of {
	my ($text) = @_;
	my %seen;
	my @block = $text =~ /^VAR\n(.*?)^END_VAR/msg;
	$seen{$1} = 1 while ($block[0] // '') =~ /^\s*(\w+)[^:\n]*:\s*(?:BOOL|S?INT|DINT|U(?:S|D)?INT|BYTE|D?WORD|TIME|REAL);/mg;
	return sort keys %seen;
}

sub stimulus {
	my ($seed, @names) = @_;
	my $text = '@print ' . join(' ', @names, '%QB0', '%QB1', '%MB0', '%MB1', 'SYS_ERRORS') . "\n";
	srand $seed;
	for (1 .. 12) {
		$text .= join ' ', map { sprintf '%%IX%d.%d=%d', rand 8, rand 8, rand 2 } 1 .. 4;
		$text .= "\n";
	}
	return $text;
}

my (%same, %refused, @bad, %why);
my $only = @ARGV > 1 && $ARGV[0] eq '--seed' ? $ARGV[1] : 0;
my @as = $ARGV[2] // ('st', 'fbd', 'back');
for my $seed ($only ? $only : 1 .. $count) {
	my $program = `$random --seed $seed --text`;
	spew("$dir/a.rung", $program);
	next if system("cd $dir && $ladder check a.rung >/dev/null 2>&1");
	spew("$dir/s", stimulus($seed, names_of($program)));
	my $was = trace_of('a.rung', 's');
	for my $as (@as) {
		my ($good, $said) = $as eq 'back' ? back('a.rung', 'b.rung') : converts('a.rung', $as, 'b.rung');
		if (!$good) {
			$refused{$as}++;
			$said =~ /error (LD\d+)/;
			$why{$1 // $said}++;
			push @bad, "seed $seed: $as: $said" if ($1 // '') !~ /^LD78/;
			next;
		}
		my $is = trace_of('b.rung', 's');
		$same{$as} += $was eq $is && $was =~ /^1 t=/;
		push @bad, "seed $seed: $as: " . first_difference($was, $is) if $was ne $is;
		print $program, slurp("$dir/b.rung"), first_difference($was, $is), "\n" if $only;
	}
}
is(@bad, 0, 'random programs do the same: ' . join ', ', map { "$same{$_} as $_, " . ($refused{$_} // 0) . ' refused' } sort keys %same)
	or diag(join "\n", @bad[0 .. ($#bad < 9 ? $#bad : 9)]);
diag(join ', ', map { "$_: $why{$_}" } sort keys %why) if $ENV{CONVERT_SAY};
for my $as (@as) {
	ok($only || $same{$as} * 2 > $count, "most random programs can be converted to $as");
}
done_testing();
