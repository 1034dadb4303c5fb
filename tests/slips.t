#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# slips.t - slips that people make in a row, a list or statements, made from words, operands and forms: each
# is refused with a message that quotes what was written, and the line that a message tells to write is read.
#
#   slips.t --show   prints each slip and its message, for a person to read
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Limit ();

my $tests = abs_path(dirname(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $dir = tempdir(CLEANUP => 1);
my $show = @ARGV && $ARGV[0] eq '--show';

my $vars = <<'END';
RUNGBOARD 1

VAR
  A, B, Sum : INT;
  Bits : WORD;
  Ready, Lamp, Horn : BOOL;
  Delay : TON;
  Rest : TOF;
  Parts : CTU;
  Pulse : TP;
  Rise : R_TRIG;
  Fall : F_TRIG;
END_VAR

END

# The last line of a file with @line in a body, its number, and what the check says about it.
sub said {
	my ($head, $line) = @_;
	my $text = "$vars$head\n  $line\nEND_PROGRAM\n";
	my $number = () = "$vars$head\n" =~ /\n/g;

	open(my $out, '>', "$dir/slip.rung") or die;
	print $out $text;
	close $out;
	my @told = grep { /: error / } `cd $dir && $ladder check slip.rung 2>&1`;
	return ($number + 1, @told);
}

# Every slip of @slips, in a body that begins with @head. @may: a pattern; messages that may have no mended line.
sub judge {
	my ($name, $head, $may, @slips) = @_;
	my (@wrong, $mended);

	for my $slip (@slips) {
		my ($number, @told) = said($head, $slip);
		my $message = $told[0] // 'good';

		$message =~ s/\s+$//;
		$message =~ s/^slip\.rung:[\d:]+ (rung \d+( \(\d+,\d+\))?: )?//;
		print "# $slip\n#    $message\n" if $show;
		if (!@told) {
			push @wrong, "$slip: is taken";
		} elsif ($told[0] !~ /^slip\.rung:$number\b/) {
			push @wrong, "$slip: another place: $told[0]";
		} elsif ($message !~ /^error \w+: "/) {
			push @wrong, "$slip: quotes nothing first: $message";
		} elsif ($message =~ /; write(?:, with [^:]*)?: (.*)$/) {
			my ($again, @more) = said($head, $1);

			$mended++;
			push @wrong, "$slip: the line to write is refused: $1: $more[0]" if @more && $more[0] !~ /LD32[0-9]|LD381|LD301: "Name"/;
		} elsif ($message !~ $may) {
			push @wrong, "$slip: no line to write: $message";
		}
	}
	ok(!@wrong, "$name: " . scalar(@slips) . ' slips, ' . ($mended // 0) . ' with the line to write');
	diag($_) for @wrong;
}

my (@values, @contacts, @coils, @outputs);

for my $block (['TON', 'Delay', '5s'], ['TOF', 'Rest', 'T#200ms'], ['TP', 'Pulse', '2.5s'], ['CTU', 'Parts', '10']) {
	my ($word, $name, $value) = @$block;

	push @values, "| NO Ready | $_ | COIL Lamp |" for "$word $name $value", "$word $name, $value",
		"$word($name, $value)", "$word $name($value)", $word eq 'CTU' ? "$word $name PV $value" : "$word $name PT $value",
		$word eq 'CTU' ? "$word $name PV:$value" : "$word $name PT:$value",
		$word eq 'CTU' ? "$word $name(PV:=$value)" : "$word $name(PT:=$value)";
}
for my $word ('ADD', 'SUB', 'MUL', 'DIV', 'MAX') {
	push @values, "| NO Ready | $_ |" for "$word A B Sum", "$word A, 5, Sum", "$word(A, B, Sum)", "$word 5 A Sum";
}
push @values, "| NO Ready | $_ |" for 'MOVE 5 A', 'MOVE A, B', 'MOVE 5 TO A', 'MOVE(A, B)';
push @values, "| NO Ready | $_ | COIL Lamp |" for 'GT A 5', 'EQ A, B', 'LE(A, 7)';
judge('values of a box', "PROGRAM Main LD\nRUNG", qr/^$/, @values);

for my $word ('NO', 'NC', 'P', 'N') {
	push @contacts, "| $_ | COIL Lamp |" for "$word (Ready)", "$word(Ready)", "$word (NOT Ready)", "$word(NOT Ready)",
		"$word NOT Ready", "$word /Ready", "$word !Ready", "$word Ready I0", "$word Ready, I0", "$word $word Ready";
}
for my $word ('NO', 'NC') {
	push @contacts, "| $word $_ | COIL Lamp |" for 'Ready AND I0', 'Ready OR Horn', 'A > 5', 'A = 5', 'A <> B', 'Ready & I0',
		'A + B > 7', '(A > 5)';
}
judge('contacts', "PROGRAM Main LD\nRUNG", qr/error LD159: ".*write |LD121: "\(/, @contacts);

for my $word ('COIL', 'S', 'R') {
	push @coils, "| NO Ready | $word $_ |" for '(Lamp)', 'Lamp Horn', 'Lamp, Horn', 'Lamp := TRUE', 'Lamp = 1', "$word Lamp",
		'5', '"Lamp"';
}
push @coils, "| NO Ready | COIL $_ |" for 'NOT Lamp', '/Lamp', '(NOT Lamp)', '(/Lamp)';
judge('coils', "PROGRAM Main LD\nRUNG", qr/error LD159: ".*write |error LD121: "["5(]/, @coils);

push @outputs, "| NO Ready | TON Delay PT:=T#1s $_ | COIL Lamp |"
	for 'NOT Q=>Horn', 'Q=>NOT Horn', 'Q=>/Horn', 'Q => NOT Horn';
judge('negated outputs of a box', "PROGRAM Main LD\nRUNG", qr/LD159: "NOT Q=>Horn"/, @outputs);

judge('negated outputs in a list', 'PROGRAM Main IL', qr/LD246: "NOT Q => Horn": .*; write Q => Horn, and behind/,
	'CAL Delay(IN := Ready, NOT Q => Horn)', 'CAL Delay(NOT Q => Horn)', 'CAL Delay(IN := Ready, Q => NOT Horn)',
	'CAL Delay(NOT Q => Horn, IN := Ready)');
# The power first, as in other tools; the contact that it was meant to be is the only one in front.
my @powers = map { my $line = $_; map { "| $line$_ | COIL Lamp |" } '', ' (* hand *)' }
	'TON Delay Ready 5s', 'TON Delay Ready T#5s', 'TON Delay Ready, 5s', 'TOF Rest Ready 200ms', 'TP Pulse %IX0.3 T#1s',
	'CTU Parts Ready 10', 'CTU Parts Ready, Horn, 10';

judge('the power of a block among its values', "PROGRAM Main LD\nRUNG", qr/^$/, @powers);

# Words and signs of other tools and other languages.
my @others = map { "| $_ | COIL Lamp |" } 'LD Ready', 'LDI Ready', 'ANI Ready', 'RISING Ready', 'FALLING Ready', 'CMP A > 5',
	'CMP A = B', 'Ready AND NOT Horn', 'Ready OR Horn', 'Ready & Horn', 'NO "Ready"', 'NC "Ready"', 'P "Ready"', 'NO %I0,3',
	'[ A > 1FH ]', '[ A = 0FFh ]', 'NO Ready | TON Delay (PT:=T#5s)', 'NO Ready | CTU Parts (PV:=3)';
push @others, map { "| NO Ready | $_ |" } 'PULSE Lamp', 'PLS Lamp', 'PLF Lamp', 'COIL "Lamp"', 'S "Lamp"', 'COIL %Q0,3',
	'MOVE 5 -> A', 'ADD A, B -> Sum', 'ADD A B => Sum', 'SUB 7 A => Sum', 'MUL(A, 2) ';
judge('words and signs of others', "PROGRAM Main LD\nRUNG", qr/error LD121: "\("/, @others);

my @edges = map { my $word = $_; map { "| $word $_ | COIL Lamp |" } 'A > 5', 'A = 5', 'A <> B', 'Ready AND Horn', '(A > 5)',
	'A + B > 7' } 'P', 'N';

judge('edges of what is no BOOL', "PROGRAM Main LD\nRUNG", qr/^$/, @edges);

# Whole cells as other controllers have them.
my @habits = map { "| $_ | COIL Lamp |" } 'NO Ready // hand', '1', '0', 'TRUE', 'NO 1', 'NC 0', '[ A > 50% ]',
	'[ A between 1 and 5 ]', '[ A > 5', 'A > 5 ]', '( A > 5 )', 'IF Ready THEN', 'IF A > 5 THEN', 'LIM 1 A 5', 'LIM 1, A, 5',
	'NO [Ready]', 'NO <Ready>', 'NO {Ready}', 'NC ~Ready', 'NO #Ready', 'NO I 0.3', 'NO Local:1:I.Data.3', '[ N7:3 > 5 ]',
	'BST XIC Ready NXB XIO Horn BND';

for my $first ('NO', 'NC', 'XIC', 'XIO') {
	for my $second ('NO', 'NC', 'XIO') {
		push @habits, "| $first Ready $_ $second Horn | COIL Lamp |" for 'AND', 'OR', '&', '';
		push @habits, "| $first Ready, $second Horn | COIL Lamp |", "| $first(Ready)$second(Horn) | COIL Lamp |";
	}
}
for my $block (['TON', 'Delay', 'PT:=T#5s', 'IN'], ['TOF', 'Rest', 'PT:=T#5s', 'IN'], ['TP', 'Pulse', 'PT:=T#5s', 'IN'],
	['CTU', 'Parts', 'PV:=5', 'CU']) {
	my ($word, $name, $value, $power) = @$block;
	my ($bare) = $value =~ /=(.*)/;

	push @habits, map { "| $_ | COIL Lamp |" } "$word $name ($power:=Ready, $value)", "$word $name($power:=NOT Ready, $value)",
		map { "NO Ready | $_" } "$word $name ($power:=Ready, $value)", "$word $name, $value", "$word $name [$value]",
		"$name $word $value", "$name $value", "$name($value)", "$word $name " . $value =~ s/:=/=>/r,
		"$word($name,7,0)", "$word $name 7000 0", $word eq 'CTU' ? () : ("$word $name S5T#5s", "$word $name PT:=00:00:05"),
		"$word $name K50";
}
push @habits, map { "| NO Ready | $_ |" } 'COIL Lamp // hand', 'COIL Lamp, COIL Horn', 'COIL Lamp COIL Horn', '= Lamp', 'S Lamp 1',
	'-(Lamp)-', '--( Lamp )--', '-(S)- Lamp', 'COIL #Lamp', 'COIL Q 0.1', 'CPT Sum A+B', 'CPT(Sum,A*2)', 'CLR Sum', 'INC Sum',
	'DEC Sum', '[ A := A + 1; B := 2 ]', 'MOV K100 A', '+ | COIL Lamp', '.... | COIL Lamp', 'NOP | COIL Lamp';
judge('cells of other controllers', "PROGRAM Main LD\nRUNG", qr/^$/, @habits);

# Rows that are drawn, with and without names, in all ways that people draw a contact and a coil.
my @drawn;
for my $contact ('| Ready |', '|Ready|', '[ Ready ]', '] Ready [', '|/ Ready |', '[/Ready]', ']/Ready[', '| |', '|/|', '] [', ']/[',
	'|P|') {
	for my $coil ('( Lamp )', '(Lamp)', '(/ Lamp )', '( )', '(S)', '(R)', '(P)', '(N)', '(/)') {
		push @drawn, "--$contact--$coil--", "|--$contact--$coil--|", "| -$contact-[ Horn ]-$coil- |", "-----$contact-----$coil";
	}
}
judge('rows that are drawn', "PROGRAM Main LD\nRUNG", qr/^$/, @drawn);

# The sign beside the word that says it already, the instance behind the values, values without :=, a pin without a value.
my @doubled = map { "| NO Ready | $_ | COIL Lamp |" } 'EQ A = 5', 'EQ A == 5', 'NE A <> B', 'NE A != 5', 'GT A > 5', 'LT A < B', 'GE A >= 5',
	'LE A <= 5', 'ADD A + B', 'SUB A - 5', 'MUL A * B', 'DIV A / 2', 'MOVE A = 5', 'A++', 'CTU Parts R Horn PV 5',
	'CTU Parts PV 5 R Horn', 'CTU Parts CU:=', 'CTU Parts PV:=5 R:=', 'TON Delay PT:=T#5s IN:=', 'COIL SET Horn', 'COIL RST Horn',
	'COIL S Horn', 'RST Horn', 'RES Horn';
for my $block (['TON', 'Delay', 'PT:=T#5s'], ['TOF', 'Rest', 'PT:=T#5s'], ['TP', 'Pulse', 'PT:=T#5s'], ['CTU', 'Parts', 'PV:=9']) {
	push @doubled, "| NO Ready | $block->[0] $block->[2] $block->[1] | COIL Lamp |",
		"| NO Ready | $block->[0] $block->[2] Q=>Horn $block->[1] | COIL Lamp |";
}
push @doubled, map { "| $_ |" } 'NO 0.00 | COIL 10.00', 'NC 0.07 | S 100.05', 'NO 1.15 | COIL 101.00', 'NO Ready | COIL Lamp | ; on',
	'NO Ready | COIL Lamp | # on';
s/(\| [;#] on) \|$/$1/ for @doubled;
judge('what is written twice, or turned around', "PROGRAM Main LD\nRUNG", qr/^$/, @doubled);

# What only the check refuses: the pins that the values belong to, the contact that an edge is.
my @pins = (map { "| NO Ready | $_ | COIL Lamp |" } 'EQ A := 5', 'GT A := B', 'ADD A := 5', 'MOVE A => B', 'MOVE A:=5');
judge('a value as the name of a pin', "PROGRAM Main LD\nRUNG", qr/LD319: "A": .*; did you mean IN1?:=\w+ (IN2:=|OUT=>)\w+\?/, @pins);
judge('an edge block with a BOOL', "PROGRAM Main LD\nRUNG", qr/LD309: "Ready" .*; for the edge of a BOOL write [PN] Ready$/,
	'| R_TRIG Ready | COIL Lamp |', '| F_TRIG Ready | COIL Lamp |');

# What Logix sets by itself.
my @bodies = (["PROGRAM Main LD\nRUNG", '| NO %s | COIL Lamp |', '| NC %s | COIL Lamp |', '| [ %s OR Ready ] | COIL Lamp |'],
	['PROGRAM Main IL', "LD %s\n  ST Lamp", "LDN %s\n  ST Lamp"]);

judge("bits of Logix, $_->[0]", $_->[0], qr/LD754: "S:(?:V|MINOR|4\/0)": controllers of Logix/,
	map { my $form = $_; map { sprintf $form, $_ } qw(S:FS S:1/15 S:V S:MINOR S:4/0) } @{$_}[1 .. $#$_])
	for @bodies;
# Members of timers and counters as other tools call them, wherever an operand is read. The message names the
# member, and the line with that in its place is good.
my @timers = (['Delay', 'TON', 'PT', 'ET', 'Q', 'IN'], ['Rest', 'TOF', 'PT', 'ET', 'Q', 'IN'],
	['Pulse', 'TP', 'PT', 'ET', 'Q', 'IN'], ['Parts', 'CTU', 'PV', 'CV', 'Q', 'CU'], ['Stock', 'CTD', 'PV', 'CV', 'Q', 'CD'],
	['Both', 'CTUD', 'PV', 'CV', 'QU', 'CU'], ['Delays[2]', 'ARRAY[1..3] OF TON', 'PT', 'ET', 'Q', 'IN']);
my %elsewhere = (2 => ['PRE', 'Preset', 'SP', 'P'], 3 => ['ACC', 'Accum', 'V', 'Current', 'Value'],
	4 => ['DN', 'dn', 'Done', 'D', 'OUT', 'Output'], 5 => ['EN', 'Enable']);
my @bits = (["PROGRAM Main LD\nRUNG", '| NO %s | COIL Lamp |', '| NC %s | COIL Lamp |', '| NO Ready | P %s | COIL Lamp |',
	'| [ NOT %s AND Ready ] | COIL Lamp |'], ['PROGRAM Main IL', "LD %s\n  ST Lamp", "LD Ready\n  ANDN %s\n  ST Lamp"],
	['PROGRAM Main ST', 'Lamp := %s;', 'IF Ready AND NOT %s THEN Lamp := TRUE; END_IF']);
my %numbers = (PT => ['[ %s > T#1s ]', 'GT IN1:=%s IN2:=T#1s'], PV => ['[ %s > 1 ]', 'GT IN1:=%s IN2:=1']);

# Is @line wrong in one place only, and good with the member that the message names?
sub member_wrong {
	my ($head, $form, $wrote, $meant) = @_;
	my $line = sprintf $form, $wrote;
	my (undef, @told) = said($head, $line);

	return "$line: @told" if @told != 1 || $told[0] !~ /error LD319: "\Q$wrote\E".*; did you mean (.*)\?$/;
	my $better = $1;
	return "$line: $better, not $meant" if $better ne $meant;
	my (undef, @more) = said($head, sprintf $form, $better);
	return @more ? "$line: $better is refused: $more[0]" : ();
}

$vars =~ s/  Rise : R_TRIG;/  Stock : CTD;\n  Both : CTUD;\n  Delays : ARRAY[1..3] OF TON;\n$&/;
my (@wrong, $members);
for my $block (@timers) {
	for my $of (sort keys %elsewhere) {
		my @forms = $of > 3 ? @bits : (["PROGRAM Main LD\nRUNG", map { "| $_ | COIL Lamp |" } @{$numbers{$block->[2]}}]);

		for my $form (@forms) {
			my ($head, @lines) = @$form;
			for my $line (@lines) {
				$members++;
				push @wrong, member_wrong($head, $line, "$block->[0].$elsewhere{$of}[$members % @{$elsewhere{$of}}]",
					"$block->[0].$block->[$of]");
			}
		}
	}
}
for my $timing (['Delay', 'Delay.IN AND NOT Delay.Q'], ['Rest', 'Rest.Q AND NOT Rest.IN']) {
	$members++;
	push @wrong, member_wrong("PROGRAM Main LD\nRUNG", '| [ %s ] | COIL Lamp |', "$timing->[0].TT", $timing->[1]);
}
ok(!@wrong, "members of timers and counters of others: $members lines");
diag($_) for @wrong;

# Limits on both sides, as in mathematics.
my @chains;
for my $first ('<', '<=', '>', '>=') {
	for my $second ('<', '<=', '>', '>=') {
		push @chains, "1 $first A $second 5", "B $first A $second Sum", "0 $first Sum $second 1";
	}
}
my @unlike;
for my $chain (@chains) {
	for my $form (["PROGRAM Main LD\nRUNG", '| [ %s ] | COIL Lamp |'], ['PROGRAM Main ST', 'Lamp := %s;'],
		['PROGRAM Main ST', 'IF %s THEN Lamp := TRUE; END_IF']) {
		my (undef, @told) = said($form->[0], sprintf $form->[1], $chain);
		my ($better) = @told == 1 ? $told[0] =~ /error LD558: "\Q$chain\E".*; write: (.*)$/ : ();
		my @more = defined $better ? (said($form->[0], sprintf $form->[1], $better))[1 .. 1] : ();

		push @unlike, "$chain: @told" if !defined $better;
		push @unlike, "$chain: $better: $more[0]" if defined $more[0];
	}
}
ok(!@unlike, 'comparisons with three sides: ' . 3 * @chains . ' lines, each with the line to write');
diag($_) for @unlike;

# Slips whose one right line is known: each of @slips is the slip and that line.
sub meant {
	my ($name, @slips) = @_;
	my @wrong;

	for (@slips) {
		my ($slip, $right, $head) = @$_;
		my ($number, @told) = said($head // "PROGRAM Main LD\nRUNG", $slip);
		my ($line) = @told ? $told[0] =~ /; write(?:, with [^:]*)?: (.*)$/ : ();

		print "# $slip\n#    ", $told[0] // "good\n" if $show;
		push @wrong, "$slip: another place: $told[0]" if @told && $told[0] !~ /^slip\.rung:$number\b/;
		push @wrong, "$slip: " . @told . ' errors' if @told != 1;
		push @wrong, "$slip: not $right: " . ($line // $told[0] // 'good') if ($line // '') ne $right;
		my (undef, @more) = said($head // "PROGRAM Main LD\nRUNG", $right);
		push @wrong, "$slip: $right is refused: $more[0]" if @more && $more[0] !~ /LD381/;
	}
	ok(!@wrong, "$name: " . scalar(@slips) . ' slips with the one right line');
	diag($_) for @wrong;
}

# A row drawn with characters: every style with contacts and coils of every kind.
my @drawings;
my %drawn_contact = ('' => 'NO', '/' => 'NC', 'P' => 'P', 'N' => 'N');
my %drawn_coil = ('' => 'COIL', '/' => 'COILNOT', 'S' => 'S', 'R' => 'R', 'P' => 'COILP', 'N' => 'COILN');
my @styles = (sub { "| $_[0]$_[1] |" }, sub { "|$_[0]| $_[1] " }, sub { "|$_[0]| $_[1] |" }, sub { "[$_[0]$_[1]]" }, sub { "[$_[0]] $_[1] " },
	sub { "]$_[0]$_[1]\[" });
my @ends = (['--', '--'], ['|--', '--|'], ['---', '---|'], ['|-', '-']);

for my $contact (sort keys %drawn_contact) {
	for my $coil (sort keys %drawn_coil) {
		for my $style (0 .. $#styles) {
			my ($left, $right) = @{$ends[($style + length $contact) % @ends]};
			my $first = $styles[$style]->($contact . ($contact =~ /\w/ && $style !~ /[124]/ ? ' ' : ''), 'Ready');
			my $second = $styles[$style]->('/', 'Horn');
			my $inside = $coil =~ /\w/ ? "$coil " : $coil;
			my $last = $style % 2 ? "($coil) Lamp " : "( ${inside}Lamp )";
			my $meant = "| $drawn_contact{$contact} Ready | NC Horn | $drawn_coil{$coil} Lamp |";

			push @drawings, ["$left$first--$second--$last$right", $meant];
		}
	}
}
push @drawings, ['--| |--( )--', '| NO %IX0.0 | COIL %QX0.0 |'], ['--| |--|/|--( )--', '| NO %IX0.0 | NC %IX0.1 | COIL %QX0.0 |'],
	['--[ A > 5 ]--( Lamp )--', '| [ A > 5 ] | COIL Lamp |'], ['|---[ Ready ]---[ Horn ]---|', '| NO Ready | COIL Horn |'],
	['--|%IX0.3|--(%QX0.1)--', '| NO %IX0.3 | COIL %QX0.1 |'], ['--| I:0/3 |--( O:0/1 )--', '| NO %IX0.3 | COIL %QX0.1 |'],
	['--| XIC Ready |--( OTE Lamp )--', '| NO Ready | COIL Lamp |'], ['--| Ready |--+--( Lamp )--', '| NO Ready | COIL Lamp |'];
meant('drawn rows', grep { $_->[0] !~ m{I:0/3} } @drawings);

# Words that compare, with a sign; a name behind the values; no name; no value; parentheses.
my @single_line;
my %test_sign = (EQ => '=', NE => '<>', GT => '>', GE => '>=', LT => '<', LE => '<=', EQU => '=', NEQ => '<>', GRT => '>', GEQ => '>=',
	LES => '<', LEQ => '<=');
for my $word (sort keys %test_sign) {
	my ($ours) = grep { $test_sign{$_} eq $test_sign{$word} && length == 2 } sort keys %test_sign;

	for my $sign (':=', '=', $test_sign{$word}) {
		push @single_line, ["| $word $_->[0] $sign $_->[1] | COIL Lamp |", "| $ours IN1:=$_->[0] IN2:=$_->[1] | COIL Lamp |"]
			for ['A', 5], ['A + 1', 'B'], ['Parts.CV', 'Sum'];
	}
}
@single_line = grep { $_->[0] !~ /A \+ 1/ } @single_line; # a pin computes nothing
push @single_line, map { ["| CMP A $_ B | COIL Lamp |", "| [ A $_ B ] | COIL Lamp |"] } '=', '<>', '>', '<=', '>=', '<';
for my $block (['TON', 'Delay', 'PT:=T#5s', 'T#5s'], ['TON', 'Delay', 'PT:=T#5s', '5s'], ['TOF', 'Rest', 'PT:=T#2s', '2s'], ['TP', 'Pulse', 'PT:=T#1s', 'T#1s'],
	['CTU', 'Parts', 'PV:=9', '9'], ['CTD', 'Stock', 'PV:=9', '9']) {
	my ($word, $name, $value, $bare) = @$block;
	my $right = "| NO Ready | $word $name $value | COIL Lamp |";

	push @single_line, map { ["| NO Ready | $word $_ | COIL Lamp |", $right] } "$value $name", "$bare $name", $value, $bare;
	push @single_line, ["| NO Ready | $word | COIL Lamp |", "| NO Ready | $word $name | COIL Lamp |"];
	my ($pin) = $value =~ /^(\w+)/;
	push @single_line, ["| NO Ready | $word $name $pin:= | COIL Lamp |",
		"| NO Ready | $word $name $pin:=" . ($pin eq 'PT' ? 'T#1s' : 1) . ' | COIL Lamp |'];
}
push @single_line, ['| NO Ready | CTU Parts CU:= |', '| NO Ready | CTU Parts |'], ['| NO Ready | CTU Parts CU:= PV:=5 |', '| NO Ready | CTU Parts PV:=5 |'],
	['| NO Ready | TON Delay IN:= PT:=T#5s |', '| NO Ready | TON Delay PT:=T#5s |'],
	['| NO Ready | P | COIL Lamp |', '| NO Ready | R_TRIG Rise | COIL Lamp |'], ['| NO Ready | N | COIL Lamp |', '| NO Ready | F_TRIG Fall | COIL Lamp |'],
	['| NO Ready | ONS Horn | COIL Lamp |', '| NO Ready | R_TRIG Rise | COIL Lamp |'],
	['| NO Ready | OSF Horn | COIL Lamp |', '| NO Ready | F_TRIG Fall | COIL Lamp |'],
	['| NO Ready | INV | COIL Lamp |', '| NO Ready | NOT | COIL Lamp |'],
	['| NC (A > 5) | COIL Lamp |', '| [ NOT (A > 5) ] | COIL Lamp |'], ['| NC (A > 5) AND Ready | COIL Lamp |', '| [ NOT ((A > 5) AND Ready) ] | COIL Lamp |'],
	['| NC (A > 5) AND (B < 3) | COIL Lamp |', '| [ NOT ((A > 5) AND (B < 3)) ] | COIL Lamp |'],
	['| NO Ready | COIL (/Lamp) |', '| NO Ready | COILNOT Lamp |'], ['| NO (/Ready) | COIL Lamp |', '| NC Ready | COIL Lamp |'],
	['| [ (A > B ] | COIL Lamp |', '| [ (A > B) ] | COIL Lamp |'], ['| [ ((A > B) AND (B > 1 ] | COIL Lamp |', '| [ ((A > B) AND (B > 1)) ] | COIL Lamp |'],
	['| [ A > B) ] | COIL Lamp |', '| [ A > B ] | COIL Lamp |'], ['| [ (A > B | COIL Lamp |', '| [ (A > B) ] | COIL Lamp |'],
	['| NO Ready | [ A := A++ ] |', '| NO Ready | [ A := A + 1 ] |'], ['| NO Ready | TON Delay PT:=0:05 |', '| NO Ready | TON Delay PT:=T#5s |'],
	['| NO Ready | TON Delay PT:=1:30 |', '| NO Ready | TON Delay PT:=T#90s |'], ['| NO Ready | MUL(A, 2) |', '| NO Ready | MUL IN1:=A IN2:=2 |'];
push @single_line, map { ["| NO Ready $_ COIL Lamp |", '| NO Ready | COIL Lamp |'] } '\\', '/', 'I', 'l', '!', ';';
for my $place (['0.00', '%IX0.0'], ['0.05', '%IX0.5'], ['1.11', '%IX3.3'], ['100.00', '%QX0.0'], ['101.15', '%QX3.7']) {
	push @single_line, map { ["| $_ $place->[0] | COIL Lamp |", "| $_ $place->[1] | COIL Lamp |"] } 'NO', 'NC', 'P', 'N';
	push @single_line, ["| LD $place->[0] | OUT 100.04 |", "| NO $place->[1] | COIL %QX0.4 |"];
}
push @single_line, ['| NO Ready | TIM 000 #50 |', '| NO Ready | TON T0 PT:=T#5s |'], ['| NO Ready | TIM 12 #5 |', '| NO Ready | TON T12 PT:=T#500ms |'],
	['| NO Ready | CNT 001 #10 |', '| NO Ready | CTU C1 PV:=10 |'];
meant('the one right line', @single_line);

# One error for what stands behind a coil, or has the wrong name at a box, or gives a box its power.
my @single = ('| COIL Lamp | NO Ready |', '| COIL Lamp | NC Ready | P Horn |', '| NO Horn | S Lamp | NO Ready |', '| EQ A := 5 | COIL Lamp |',
	'| ADD X := 5 | COIL Lamp |', '| CTU Parts CU:=%IX0.0 PV:=5 |', '| TON Delay IN:=/Ready PT:=T#5s |');
my @several = grep { my (undef, @told) = said("PROGRAM Main LD\nRUNG", $_); @told != 1 } @single;
ok(!@several, 'one slip, one error');
diag($_) for @several;
done_testing();
