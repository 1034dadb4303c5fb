#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# sfc_cases.pl - writes main.rung and stimulus of the golden cases sfc-*.
#
#   tests/sfc_cases.pl [DIR]        usually tests/golden
#
# Every qualifier, every structure of a chart, each two of them together. What a case
# expects is not made here: `make bless CASE=…` does that, build/tests/bin/sfc_trace (the
# walker) must say the same, and a person reads it against docs/sfc.md.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use lib abs_path(dirname(__FILE__));
use Files;

my $to = $ARGV[0] // 'tests/golden';
my @qualifiers = qw(N S R L D P P0 P1 SD DS SL);
my %timed = map { $_ => 1 } qw(L D SD DS SL);

# One case: the text between the heading and END_PROGRAM, and the script.
sub case {
	my ($name, $chart, $stimulus, $head) = @_;
	mkdir "$to/sfc-$name" unless -d "$to/sfc-$name";
	$head //= '';
	spew("$to/sfc-$name/main.rung", "RUNGBOARD 1\n\nPROGRAM Main SFC$head\n${chart}END_PROGRAM\n");
	spew("$to/sfc-$name/stimulus", $stimulus);
}

# Inputs from %IX0.0 on, outputs from %QX0.0 on, other variables unchanged.
sub vars {
	my ($inputs, $outputs, @more) = @_;
	my $text = "  VAR\n";
	my $n = 0;
	$text .= sprintf "    %s AT %%IX%d.%d : BOOL;\n", $_, $n / 8, $n++ % 8 for @$inputs;
	$n = 0;
	$text .= sprintf "    %s AT %%QX%d.%d : BOOL;\n", $_, $n / 8, $n++ % 8 for @$outputs;
	$text .= "    $_;\n" for @more;
	return "$text  END_VAR\n\n";
}

sub call {
	my ($target, $qualifier, $time) = @_;
	$time //= 'T#30ms';
	return $timed{$qualifier} ? "    $target($qualifier, $time);\n" :
				    "    $target($qualifier);\n";
}

sub step {
	my ($name, @lines) = @_;
	my $word = $name =~ s/^!// ? 'INITIAL_STEP' : 'STEP';
	return "  $word $name:\n" . join('', @lines) . "  END_STEP\n\n";
}

sub arc {
	my ($from, $to_steps, $condition) = @_;
	return "  TRANSITION FROM $from TO $to_steps := $condition; END_TRANSITION\n\n";
}

sub counting {
	my ($name, $counter, $more) = @_;
	$more //= '';
	return "  ACTION $name:\n    RUNG\n      | [ $counter := $counter + 1 ] |\n$more" .
	       "  END_ACTION\n\n";
}

sub statement {
	my ($name, $counter) = @_;
	return "  ACTION $name:\n    $counter := $counter + 1;\n  END_ACTION\n\n";
}

# ---- each qualifier: a BOOL, a body, a short and a long step, and an R ----
for my $q (@qualifiers) {
	my $chart = vars(['Go', 'End', 'Clear'], ['Out', 'Lamp'], 'Runs : INT');
	$chart .= step('!Idle');
	$chart .= step('Work', call('Out', $q), call('Act', $q));
	$chart .= step('Rest', $q eq 'R' ? (call('Out', 'S'), call('Act', 'S')) : ());
	$chart .= step('Wipe', call('Out', 'R'), call('Act', 'R'));
	$chart .= arc('Idle', 'Work', 'Go') . arc('Work', 'Rest', 'End');
	$chart .= arc('Rest', 'Wipe', 'Clear') . arc('Wipe', 'Idle', 'NOT Clear');
	$chart .= counting('Act', 'Runs', "    RUNG\n      | NO Work.X | COIL Lamp |\n");
	my $short = "Go=1\nGo=0\nEnd=1\nEnd=0\n.\n.\n.\nClear=1\n.\nClear=0\n";
	my $long = "Go=1\nGo=0\n.\n.\n.\n.\nEnd=1\nEnd=0\n.\nClear=1\n.\nClear=0\n";
	case("qualifier-$q", $chart, "\@print Work.X Work.T Wipe.X Out Runs Lamp\n.\n$short.\n$long.\n");
}

# ---- two qualifiers: two overlapping steps call the same action ----
# A has the first qualifier, B each of the others; then one after the other, then an R.
for my $kind ('bool', 'body', 'st') {
	for my $q (@qualifiers) {
		my (@a, @b, @wipe, $bodies);
		my @targets = map { $kind eq 'bool' ? "Out$_" : "Act$_" } @qualifiers;
		for my $other (@qualifiers) {
			my $target = ($kind eq 'bool' ? 'Out' : 'Act') . $other;
			push @a, call($target, $q, 'T#40ms');
			push @b, call($target, $other, 'T#30ms');
			push @wipe, call($target, 'R');
			$bodies .= counting($target, "n$other") if $kind eq 'body';
			$bodies .= statement($target, "n$other") if $kind eq 'st';
		}
		my $chart = $kind eq 'bool' ? vars(['Go', 'BGo', 'AEnd', 'BEnd', 'Done'], \@targets) :
			vars(['Go', 'BGo', 'AEnd', 'BEnd', 'Done'], [], map { "n$_ : INT" } @qualifiers);
		$chart .= step('!Idle') . step('A', @a) . step('ANot') . step('BNot');
		$chart .= step('B', @b) . step('BOver') . step('Wipe', @wipe);
		$chart .= arc('Idle', '(A, BNot)', 'Go') . arc('BNot', 'B', 'BGo');
		$chart .= arc('A', 'ANot', 'AEnd') . arc('B', 'BOver', 'BEnd');
		$chart .= arc('(ANot, BOver)', 'Wipe', 'Done') . arc('Wipe', 'Idle', 'NOT Done');
		$chart .= $bodies if $kind ne 'bool';
		my @shown = $kind eq 'bool' ? @targets : map { "n$_" } @qualifiers;
		my $both = "Go=1\nGo=0\nBGo=1\nBGo=0\n.\nAEnd=1\nAEnd=0\n.\nBEnd=1\nBEnd=0\n.\nDone=1\nDone=0\n";
		my $after = "Go=1\nGo=0\nAEnd=1\nAEnd=0\nBGo=1\nBGo=0\n.\n.\n.\nBEnd=1\nBEnd=0\nDone=1\nDone=0\n.\n";
		case("two-$kind-$q", $chart, "\@print A.X B.X Wipe.X @shown\n.\n$both$after");
	}
}

# ---- structures ----
# Each is a part of a chart between two given steps; its steps have its name. @inner, if
# any, is inside its first branch.
my ($serial, @names, @deferred);

sub fresh {
	my ($name) = @_;
	$name .= $serial++ || '';
	push @names, $name;
	return $name;
}

# A step and its transition; returns the text and the step.
sub after {
	my ($from, $name, $condition, @lines) = @_;
	my $new = fresh($name);
	return (step($new, @lines) . arc($from, $new, $condition // "$from.T >= T#10ms"), $new);
}

my %make;

sub make {
	my ($from, $kind, @inner) = @_;
	return ('', $from) unless defined $kind;
	return $make{$kind}->($from, @inner);
}

$make{sequence} = sub {
	my ($from, @inner) = @_;
	my ($text, $at) = after($from, 'One');
	my ($more, $then) = make($at, @inner);
	my ($last, $end) = after($then, 'Two');
	return ($text . $more . $last, $end);
};

# Pick: the left branch; otherwise the right one.
$make{selective} = sub {
	my ($from, @inner) = @_;
	my ($left, $l) = after($from, 'Left', "Pick AND ($from.T >= T#10ms)");
	my ($more, $then) = make($l, @inner);
	my ($right, $r) = after($from, 'Right', "NOT Pick AND ($from.T >= T#10ms)");
	my $join = fresh('Joined');
	return ($left . $more . $right . step($join) . arc($then, $join, "$then.T >= T#10ms") .
		arc($r, $join, "$r.T >= T#20ms"), $join);
};

# Both conditions are true: the number decides, not the order in the file.
$make{priority} = sub {
	my ($from, @inner) = @_;
	my ($second, $first, $join) = (fresh('Second'), fresh('First'), fresh('Joined'));
	my ($more, $then) = make($first, @inner);
	return (step($second) . step($first) . $more . step($join) .
		"  TRANSITION FROM $from TO $second := $from.T >= T#10ms; END_TRANSITION\n\n" .
		"  TRANSITION (PRIORITY := 2) FROM $from TO $second := $from.T >= T#10ms; END_TRANSITION\n\n" .
		"  TRANSITION (PRIORITY := 1) FROM $from TO $first := Pick AND ($from.T >= T#10ms); END_TRANSITION\n\n" .
		arc($then, $join, "$then.T >= T#10ms") . arc($second, $join, "$second.T >= T#10ms"), $join);
};

# The shorter branch waits for the longer one.
$make{simultaneous} = sub {
	my ($from, @inner) = @_;
	my ($up, $down, $join) = (fresh('Up'), fresh('Down'), fresh('Joined'));
	my ($more, $then) = make($up, @inner);
	my ($wait, $waits) = after($down, 'Waits', "$down.T >= T#30ms");
	return (step($up) . $more . step($down) . $wait . step($join) .
		arc($from, "($up, $down)", "$from.T >= T#10ms") .
		arc("($then, $waits)", $join, "$then.T >= T#10ms"), $join);
};

# Again while Again is TRUE.
$make{loop} = sub {
	my ($from, @inner) = @_;
	my ($text, $body) = after($from, 'Body');
	my ($more, $then) = make($body, @inner);
	my ($end_text, $end) = after($then, 'Ending');
	my ($out, $done) = after($end, 'Done', "NOT Again AND ($end.T >= T#10ms)");
	return ($text . $more . $end_text . arc($end, $body, "Again AND ($end.T >= T#10ms)") . $out, $done);
};

# Skips a step if Skip is TRUE.
$make{jump} = sub {
	my ($from, @inner) = @_;
	my ($text, $way) = after($from, 'Way', "NOT Skip AND ($from.T >= T#10ms)");
	my ($more, $then) = make($way, @inner);
	my ($last, $end) = after($then, 'Goal');
	return ($text . $more . $last . arc($from, $end, "Skip AND ($from.T >= T#10ms)"), $end);
};

$make{macro} = sub {
	my ($from, @inner) = @_;
	my ($macro, $in) = (fresh('Macro'), fresh('In'));
	my ($more, $then) = make($in, @inner);
	my ($last, $out) = after($then, 'Out');
	my $inside = "  INITIAL_STEP $in:\n  END_STEP\n\n$more$last";
	$inside =~ s/^(?=.)/  /mg;
	return ("  MACRO_STEP $macro:\n$inside  END_STEP\n\n" .
		arc($from, $macro, "$from.T >= T#10ms"), $macro);
};

my @structures = qw(sequence selective priority simultaneous loop jump macro);

# A ring: from Start through the structures to Last and back.
sub ring {
	my ($vars, $first_lines, @kinds) = @_;
	($serial, @names) = (0);
	my $from = fresh('Start');
	my ($text, $at) = make($from, @kinds);
	my ($last, $end) = after($at, 'Last');
	return $vars . step("!$from", @$first_lines) . $text . $last . arc($end, $from, "$end.T >= T#10ms");
}

my @choices = ('Pick', 'Again', 'Skip');
my $walk = ".\n" x 11 . "Pick=1 Again=1 Skip=1\n" . ".\n" x 9 . "Again=0 Skip=0\n" . ".\n" x 9;

sub print_steps {
	return '@print ' . join(' ', map { "$_.X" } @names[0 .. ($#names < 22 ? $#names : 22)]) . "\n";
}

for my $kind (@structures) {
	my $chart = ring(vars(\@choices, []), [], $kind);
	case("structure-$kind", $chart, print_steps() . $walk);
	for my $inner (@structures) {
		$chart = ring(vars(\@choices, []), [], $kind, $inner);
		case("two-$kind-$inner", $chart, print_steps() . $walk);
	}
}

# ---- UNTIL STABLE, with each structure: only Wait waits ----
# Steps that can be left at once are passed in one scan; a step at the end runs its SET.
for my $kind (@structures) {
	my $chart = ring(vars([@choices, 'Go'], ['Seen', 'Pulse']), [], $kind);
	$chart =~ s/\(?\w+\.T >= T#\d+ms\)?/TRUE/g;
	$chart =~ s/(FROM Last\S* TO Start) := TRUE/$1 := FALSE/;
	$chart =~ s/(FROM Start TO \S+(?: \S+\))?) := (.*?);/$1 := Go AND ($2);/g;
	$chart =~ s/(FROM Last\S* TO Start) := FALSE/$1 := NOT Go/;
	$chart =~ s/(  STEP (?:One|Left|Right|First|Second|Up|Body|Way|Out)\d*:\n)/$1    SET Seen;\n    Pulse(P1);\n/;
	my $stimulus = print_steps();
	$stimulus =~ s/\n/ Seen Pulse\n/;
	case("stable-$kind", $chart, "$stimulus.\n.\nGo=1\n.\nGo=0\n.\nPick=1 Skip=1\nGo=1\n.\nGo=0\n.\n", ' UNTIL STABLE');
	case("order-$kind", $chart, "$stimulus.\n.\nGo=1\n.\nGo=0\n.\nPick=1 Skip=1\nGo=1\n.\nGo=0\n.\n", ' IN ORDER');
}

# ---- qualifiers within structures: one step uses all of them ----
my @all = map { "Out$_" } @qualifiers;
my @called = map { call("Out$_", $_, 'T#20ms') } @qualifiers;

# Beside another step; in the shorter branch; twice in a loop; in a macro-step; in a step
# that is passed in one scan.
for my $kind (qw(selective simultaneous loop macro)) {
	my $chart = ring(vars([@choices], \@all), [], $kind);
	my %in = (selective => 'Right', simultaneous => 'Down', loop => 'Body', macro => 'In');
	$chart =~ s/(STEP $in{$kind}\d*:\n)/$1@{[join '', @called]}/;
	$chart =~ s/(STEP Last\d*:\n)/$1@{[join '', map { call($_, 'R') } grep { $_ ne 'OutR' } @all]}/;
	my ($step) = grep { /^$in{$kind}/ } @names;
	my $again = $kind eq 'loop' ? 'Again=1' : '.';
	case("in-$kind", $chart, "\@print $step.X $names[-1].X @all\n$again\n" . ".\n" x 5 . "Again=0\n" . ".\n" x 8);
}
{
	my $chart = vars(['Go', 'Back'], \@all) . step('!Idle') . step('Passing', @called) . step('Goal') .
		step('Wipe', map { call($_, 'R') } @all) .
		arc('Idle', 'Passing', 'Go') . arc('Passing', 'Goal', 'TRUE') .
		arc('Goal', 'Wipe', 'Back AND NOT Go') . arc('Wipe', 'Idle', 'NOT Back');
	my $stimulus = "\@print Idle.X Passing.X Goal.X @all\n.\nGo=1\n.\n.\nGo=0\nBack=1\n.\nBack=0\n.\n";
	case('in-stable', $chart, $stimulus, ' UNTIL STABLE');
	case('in-order', $chart, $stimulus, ' IN ORDER');
}

# ---- supervision ----
{
	my $chart = vars(['Go', 'End', 'Ack'], ['Short', 'Long']) . step('!Idle', "    RESET Short;\n") .
		"  STEP Work (MIN := T#20ms, ALARM := Short):\n  END_STEP\n\n" .
		"  STEP Slow (MAX := T#20ms, ALARM := Long):\n    Clear();\n  END_STEP\n\n" .
		arc('Idle', 'Work', 'Go') . arc('Work', 'Slow', 'End') . arc('Slow', 'Idle', 'NOT Go') .
		"  ACTION Clear:\n    RUNG\n      | NO Ack | R Long |\n  END_ACTION\n\n";
	my $stimulus = "\@print Work.X Work.T Short Slow.X Slow.T Long\n.\nGo=1\nEnd=1\n.\n.\n.\nAck=1\nAck=0\nGo=0 End=0\n" .
		"Ack=1\nGo=1\n.\n.\nEnd=1\nGo=0\n.\n";
	case('supervision', $chart, $stimulus);
}
for my $kind (@structures) {
	my $chart = ring(vars(\@choices, ['Early', 'Late']), [], $kind);
	my $last = $names[-1];
	$chart =~ s/(?<!INITIAL_)(\w*STEP (?:Two|Left|First|Down|Ending|Way|Macro)\d*):/$1 (MIN := T#15ms, ALARM := Early):/;
	$chart =~ s/STEP (One|Right|Second|Up|Body|Goal|Out)(\d*):/STEP $1$2 (MAX := T#5ms, ALARM := Late):/;
	$chart =~ s/(INITIAL_STEP Start:\n)/$1    RESET Early, Late;\n/;
	my $stimulus = print_steps();
	$stimulus =~ s/\n/ Early Late\n/;
	case("supervision-$kind", $chart, $stimulus . ".\n" x 10 . "Pick=1 Skip=1 Again=1\n" . ".\n" x 9);
}

# ---- CONTROL, each, in each structure ----
my @controls = ('CReset AT %IX1.0 : BOOL', 'CHold AT %IX1.1 : BOOL', 'CSemi AT %IX1.2 : BOOL',
	'CManual AT %IX1.3 : BOOL', 'CTip AT %IX1.4 : BOOL', 'CForce AT %IB2 : USINT');
my %control = (
	reset => ['RESET := CReset', ".\n.\n.\nCReset=1\n.\n.\nCReset=0\n.\n.\n.\nCReset=1\nCReset=0\n.\n"],
	hold => ['HOLD := CHold', ".\n.\n.\nCHold=1\n.\n.\nCHold=0\n.\n.\nCHold=1\nCHold=0\n.\n"],
	semi => ['SEMI := CSemi, TIP := CTip', ".\nCSemi=1\n.\nCTip=1\n.\nCTip=0\nCTip=1\nCTip=0\n.\nCSemi=0\n.\n.\nCSemi=1 CTip=1\n.\n"],
	manual => ['MANUAL := CManual, TIP := CTip', "CManual=1\nCTip=1\nCTip=0\nCTip=1\n.\n.\nCTip=0\nCTip=1\nCTip=0\nCTip=1\nCTip=0\nCManual=0\n.\n.\n"],
	force => ['FORCE := CForce', "CForce=3\n.\nCForce=1\nCForce=4\n.\nCForce=99\n.\nCForce=2\n.\nCForce=0\n.\n"],
	all => ['RESET := CReset, HOLD := CHold, SEMI := CSemi, MANUAL := CManual, TIP := CTip, FORCE := CForce',
		".\n.\nCHold=1 CForce=3\n.\nCReset=1\nCForce=2\nCReset=0\n.\nCHold=0 CSemi=1\nCTip=1\nCManual=1 CTip=0\nCTip=1\n" .
		"CSemi=0 CTip=0\nCManual=0\n.\nCForce=3 CReset=1\nCReset=0\nCHold=1 CTip=1\nCHold=0 CSemi=1\nCTip=0\nCTip=1 CForce=4\n.\n"],
);
for my $name (sort keys %control) {
	my ($words, $stimulus) = @{$control{$name}};
	for my $kind ($name eq 'all' ? qw(simultaneous macro) : @structures) {
		my $chart = ring(vars(\@choices, ['Stored', 'Ended', 'Limited', 'Delayed'], @controls) .
			"  CONTROL($words);\n\n", [call('Ended', 'P0'), "    SET Limited;\n"], $kind);
		$chart =~ s/(STEP (?:One|Right|Second|Down|Body|Way|In)\d*:\n)/$1    Stored(S);\n    Delayed(SD, T#40ms);\n    RESET Limited;\n/;
		my $print = '@print ' . join(' ', map { "$_.X" } @names) . " $names[1].T Stored Delayed Ended Limited\n";
		case("control-$name-$kind", $chart, $print . $stimulus);
	}
}

# ---- other statements of docs/sfc.md ----
# Two tokens in one step are one; an active step is not entered again.
{
	my $chart = vars(['Go', 'Join', 'Back'], ['Out'], 'Entered : INT', 'Runs : INT') .
		step('!Idle') . step('A') . step('B') . step('Meet', call('Count', 'P1'), call('Run', 'N')) .
		arc('Idle', '(A, B)', 'Go') . arc('A', 'Meet', 'TRUE') . arc('B', 'Meet', 'Join') .
		arc('Meet', 'Idle', 'Back') . counting('Count', 'Entered') . counting('Run', 'Runs');
	case('tokens-meet', $chart, "\@print Idle.X A.X B.X Meet.X Meet.T Entered Runs\n.\nGo=1\nGo=0\n.\nJoin=1\n.\nBack=1\n.\n");
}
# A step that is left and entered in one scan: its T continues, nothing starts again, no
# alarm.
{
	my $chart = vars(['Self', 'End'], ['Early', 'Left', 'Mark'], 'Entered : INT') .
		"  INITIAL_STEP Work (MIN := T#500ms, ALARM := Early):\n    SET Mark;\n    Left(P0);\n    Count(P1);\n  END_STEP\n\n" .
		step('Over', "    RESET Mark;\n") .
		arc('Work', 'Work', 'Self') . arc('Work', 'Over', 'End') . arc('Over', 'Work', 'NOT End') . counting('Count', 'Entered');
	case('left-and-entered', $chart, "\@print Work.X Work.T Early Left Mark Entered\n.\n.\nSelf=1\n.\nSelf=0\nEnd=1\n.\nEnd=0\n.\n");
}
# Two transitions that need one of two steps each, and one that needs both.
{
	my $chart = vars(['A', 'B', 'AB', 'Go'], []) . step('!Idle') . step('Lt') . step('Rt') . step('L2') . step('R2') . step('Both') .
		arc('Idle', '(Lt, Rt)', 'Go') . arc('Lt', 'L2', 'A') . arc('(Lt, Rt)', 'Both', 'AB') . arc('Rt', 'R2', 'B') .
		arc('(L2, R2)', 'Idle', 'NOT Go') . arc('Both', 'Idle', 'NOT Go');
	my $again = $chart =~ s/TRANSITION FROM \(Lt, Rt\)/TRANSITION (PRIORITY := 7) FROM (Lt, Rt)/r;
	my $stimulus = "\@print Idle.X Lt.X Rt.X L2.X R2.X Both.X\n.\nGo=1\nA=1 AB=1 B=1\n.\nGo=0\n.\nA=0 Go=1\n.\nB=0\n.\nGo=0\n.\n";
	case('wanted-by-two', $chart, $stimulus);
	case('wanted-by-two-priority', $again, $stimulus);
}
# Conditions of inactive steps are not evaluated: edges, timers.
{
	my $chart = vars(['Go', 'Edge', 'On'], [], 'Delay : TON') . step('!Idle') . step('Seen') . step('Timed') . step('Over') .
		arc('Idle', 'Seen', 'Go') .
		"  TRANSITION FROM Seen TO Timed:\n    RUNG\n      | P Edge | COIL TRANSITION |\n  END_TRANSITION\n\n" .
		"  TRANSITION FROM Timed TO Over:\n    RUNG\n      | NO On | TON Delay PT:=T#20ms | COIL TRANSITION |\n  END_TRANSITION\n\n" .
		"  TRANSITION FROM Over TO Idle:\n    LD Go\n    OR( On\n    AND Edge\n    )\n    NOT\n  END_TRANSITION\n\n";
	case('conditions', $chart, "\@print Idle.X Seen.X Timed.X Over.X Delay.Q Delay.ET\nEdge=1 On=1\n.\nGo=1\n.\n.\nEdge=0\nEdge=1\n.\n.\n.\nGo=0\nOn=0\n" .
		"Edge=0\nGo=1\nEdge=1\n.\n");
}
# The final scan: a coil by Step.X, a timer, a list; none for an action that was only
# passed.
{
	my $chart = vars(['Go', 'End'], ['Lit', 'Kept', 'Late'], 'Over : TOF', 'Runs : INT', 'Lists : INT') . step('!Idle') .
		step('Work', call('Rungs', 'N'), call('List', 'N'), call('Rungs', 'P0')) .
		arc('Idle', 'Work', 'Go') . arc('Work', 'Idle', 'End') .
		counting('Rungs', 'Runs', "    RUNG\n      | NO Work.X | COIL Lit |\n    RUNG\n      | NO Go | JMP Last |\n    RUNG\n      | [ TRUE ] | COIL Kept |\n" .
			"    RUNG\n      | NO End | RET |\n    RUNG Last\n      | NO Work.X | TOF Over PT:=T#15ms | COIL Late |\n") .
		"  ACTION List:\n    LD Lists\n    ADD 1\n    ST Lists\n    LD Work.X\n    JMPC Last\n    LD Lists\n    ADD 100\n    ST Lists\n  Last:\n    LD Go\n    RETC\n    LD Lists\n    ADD 1000\n    ST Lists\n  END_ACTION\n\n";
	case('final-scan', $chart, "\@print Work.X Lit Kept Late Runs Lists\n.\nGo=1\n.\nGo=0\n.\nEnd=1\nEnd=0\n.\nGo=1\nGo=0 End=1\n.\n");
}
# Actions run in the order of the file, then BOOLs; calls are determined before.
{
	my $chart = vars(['Go'], ['First'], 'N : INT', 'Wait : TIME := T#20ms') . step('!Idle') .
		step('Work', "    First(L, Wait);\n", call('Second', 'N'), call('Begin', 'N')) .
		arc('Idle', 'Work', 'Go') . arc('Work', 'Idle', 'NOT Go') .
		"  ACTION Begin:\n    RUNG\n      | [ N := N * 2 ] | [ Wait := T#0ms ] |\n    RUNG\n      | NO First | [ N := N + 50 ] |\n  END_ACTION\n\n" .
		"  ACTION Second:\n    RUNG\n      | [ N := N + 1 ] |\n  END_ACTION\n\n";
	case('order', $chart, "\@print Work.X First N Wait\n.\nGo=1\n.\n.\nGo=0\n.\n");
}
# SET and RESET run in the order of the file, only in the scan of the entry.
{
	my $chart = vars(['Go', 'Other'], ['A', 'B', 'C']) .
		"  STEP Late:\n    RESET A;\n    SET B, C;\n    RESET C;\n  END_STEP\n\n" . step('!Idle', "    SET C;\n") . step('Early', "    SET A;\n    RESET B;\n    Undo();\n") .
		arc('Idle', '(Early, Late)', 'Go') . arc('(Early, Late)', 'Idle', 'NOT Go') .
		"  ACTION Undo:\n    RUNG\n      | NO Other | R A |\n  END_ACTION\n\n";
	case('set-and-reset', $chart, "\@print Idle.X Early.X A B C\n.\nGo=1\n.\nOther=1\nOther=0\nGo=0\nGo=1\n.\n");
}
# Nested macro-steps, each with lines; one with a single step; FORCE into them.
{
	my $chart = vars(['Go', 'In', 'Out', 'Hold'], ['Outer', 'Inner', 'Deep'], 'CForce AT %IB2 : USINT', 'Entered : INT') .
		"  CONTROL(FORCE := CForce);\n\n" . step('!Idle') .
		"  MACRO_STEP M:\n    Outer();\n    INITIAL_STEP A:\n    END_STEP\n\n    MACRO_STEP K:\n      Inner();\n      Count(P1);\n      INITIAL_STEP B:\n        Deep();\n      END_STEP\n    END_STEP\n" .
		"    TRANSITION FROM A TO K := In; END_TRANSITION\n  END_STEP\n\n" . step('Over') .
		arc('Idle', 'M', 'Go') . arc('M', 'Over', 'Out') . arc('Over', 'Idle', 'NOT Go') . counting('Count', 'Entered');
	case('macro-in-macro', $chart, "\@print Idle.X M.X M.T A.X K.X B.X B.T Over.X Outer Inner Deep Entered\n.\nGo=1\nOut=1\n.\nIn=1\n.\nGo=0\nOut=0 In=0\n" .
		"CForce=5\n.\nCForce=2\n.\nCForce=4\nCForce=3\nOut=1\n.\n");
}
# A chart that never becomes stable, because of one line of the file, which the message
# names.
{
	my $chart = vars(['Go'], ['Out']) . step('!Idle', call('Out', 'N')) . step('Round') .
		arc('Idle', 'Round', 'Go') . arc('Round', 'Idle', 'TRUE');
	$chart =~ s/(?<!END_VAR)\s+/ /g;
	case('stable-never', $chart, "\@print Go\n.\n.\nGo=1\n.\n", ' UNTIL STABLE');
	my $text = "RUNGBOARD 1\nPROGRAM Main SFC UNTIL STABLE\n$chart\nEND_PROGRAM\n";
	spew("$to/sfc-stable-never/main.rung", $text);
}
# IN ORDER: the same chart goes round 50 times a scan, and continues. Each round counts.
{
	my $chart = vars(['Go'], ['Out'], 'Rounds : INT') . step('!Idle', call('Out', 'N')) . step('Round') .
		arc('Idle', 'Round', 'Go') .
		"  TRANSITION FROM Round TO Idle:\n    RUNG\n      | [ Rounds := Rounds + 1 ] | COIL TRANSITION |\n  END_TRANSITION\n\n";
	case('order-never', $chart, "\@print Idle.X Round.X Out Rounds\n.\n.\nGo=1\n.\n.\nGo=0\n.\n", ' IN ORDER');
}
# Without a previous step, without a next step; the order of the file decides; a step that
# enters itself starts again.
{
	my $chart = vars(['New', 'Go', 'Pick', 'Gone', 'Self'], ['Seen', 'Pulse', 'Ended']) .
		step('A', "    SET Seen;\n", call('Pulse', 'P1'), call('Ended', 'P0')) . step('B') . step('C') .
		"  TRANSITION FROM B := Gone; END_TRANSITION\n\n" .
		"  TRANSITION FROM (C, B) := FALSE; END_TRANSITION\n\n" .
		arc('A', 'B', 'Go') . arc('A', 'C', 'Go OR Pick') . arc('A', 'A', 'Self') . arc('C', '(A, B)', 'Gone') .
		"  TRANSITION (PRIORITY := 1) TO A := New; END_TRANSITION\n\n";
	case('order-open', $chart, "\@print A.X A.T B.X C.X Seen Pulse Ended\n.\nNew=1\nNew=0\n.\nSelf=1\n.\nSelf=0\n.\nGo=1\n" .
		"Go=0 New=1\nNew=0\nPick=1\n.\nPick=0 Gone=1\nGone=0\n.\n", ' IN ORDER');
}
# One TIP is one transition.
{
	my $chart = vars(['Hold', 'Semi', 'Manual', 'Tip', 'Back'], ['Out'], 'Force AT %IB2 : USINT') .
		"  CONTROL(RESET := Back, HOLD := Hold, SEMI := Semi, MANUAL := Manual, TIP := Tip, FORCE := Force);\n\n" .
		step('!A') . step('B', call('Out', 'P')) . step('C') . step('D') .
		arc('A', 'B', 'TRUE') . arc('B', 'C', 'TRUE') . arc('C', 'D', 'FALSE') . arc('D', 'A', 'FALSE');
	case('order-control', $chart, "\@print A.X B.X C.X D.X Out\nSemi=1\n.\nTip=1\n.\nTip=0\nTip=1\n.\nTip=0\nManual=1\nTip=1\n.\nTip=0\nTip=1\n" .
		"Tip=0\nSemi=0 Manual=0\n.\nBack=1\n.\nHold=1 Back=0\n.\nHold=0\n.\nForce=4\n.\nForce=1\n.\n", ' IN ORDER');
}
# Two rings of one chart: two initial steps.
{
	my $chart = vars(['A', 'B'], []) . step('!A0') . step('A1') . step('!B0') . step('B1') .
		arc('A0', 'A1', 'A AND B0.X') . arc('A1', 'A0', 'NOT A') . arc('B0', 'B1', 'B AND A0.X') . arc('B1', 'B0', 'NOT B');
	case('two-rings', $chart, "\@print A0.X A1.X B0.X B1.X\n.\nA=1\nB=1\nA=0\n.\nB=0\nA=1 B=1\n.\n");
}
