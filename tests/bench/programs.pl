#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# programs - writes the ladders that `make bench` measures: programs.pl KIND N
#
# seal:   N rungs of a start button, a stop button and a motor with seal-in
# mixed:  N rungs, alternately a timer, a counter, a comparison and a sum
# ton, ctu, compare, sum: N rungs of one of these, each with an input and an output; product: of a product and a sum of REAL
# dense:  N rungs of 8 x 6 contacts with a link at every cell
# empty:  one rung, as small as possible
# chart:  a chart of N steps, 50 in each of its simultaneous sequences, so that N / 50 are
#         active; 6 transitions for 5 steps, every fifth step has a choice
# lines:  N lines of Structured Text in one program: conditions, sums, calls of one function
# blocks: N lines of Structured Text in function blocks of 100 lines, and a program with an instance of each;
#         parts: of 10 lines
# others: N rungs of one family of words (%family); network: N networks of 6 blocks in FBD, network_ld: the same in LD
use strict;
use warnings;

# The declarations and the text of a rung of a family; # is its number.
my %family = (
	real => ['A# : REAL := 1.5; B# : REAL := 0.25; C# : REAL; Out# : BOOL;',
		'| ADD IN1:=A# IN2:=B# OUT=>C# | GT IN1:=C# IN2:=A# | COIL Out# |'],
	lreal => ['A# : LREAL := 1.5; C# : LREAL;', '| SIN IN:=A# OUT=>C# |'],
	bits => ['A# : WORD := 16#1234; C# : WORD;', '| AND IN1:=A# IN2:=16#0FF0 OUT=>C# | SHL IN:=C# N:=3 OUT=>C# |'],
	convert => ['A# : INT := 1234; C# : REAL; D# : INT;', '| INT_TO_REAL IN:=A# OUT=>C# | REAL_TO_INT IN:=C# OUT=>D# |'],
	select => ['A# : INT := 7; C# : INT;', '| LIMIT MN:=1 IN:=A# MX:=5 OUT=>C# | SEL G:=TRUE IN0:=A# IN1:=C# OUT=>C# |'],
	text => ["A# : STRING[16] := 'abc'; C# : STRING[32];", "| CONCAT IN1:=A# IN2:='def' OUT=>C# |"],
	time => ['A# : TIME_OF_DAY := TOD#08:30:00; C# : TIME_OF_DAY;', '| ADD_TOD_TIME IN1:=A# IN2:=T#1s OUT=>C# |'],
	timer => ['In# : BOOL := TRUE; Out# : BOOL; Delay# : TON;', '| NO In# | TON Delay# PT:=T#1s | COIL Out# |'],
	counter => ['In# : BOOL := TRUE; Out# : BOOL; Count# : CTU_DINT;', '| NO In# | CTU_DINT Count# PV:=100 | COIL Out# |'],
	store => ['In# : BOOL := TRUE; Out# : BOOL; Queue# : FIFO;', '| NO In# | FIFO Queue# IN:=5 | COIL Out# |'],
	analog => ['A# : REAL := 4.0; Ramp# : RAMP;', '| RAMP Ramp# IN:=A# UP:=1.0 DOWN:=1.0 |'],
	pid => ['A# : REAL := 4.0; Loop# : PID;', '| PID Loop# PV:=A# SP:=5.0 KP:=1.0 TI:=T#1s |'],
	array => ['I# : INT := 3; T# : ARRAY[0..7] OF INT; C# : INT;', '| MOVE IN:=T#[I#] OUT=>C# |'],
	noise => ['A# : LINT := #;', '| [ A# := (A# * 1103515245 + 12345) MOD 2147483648 ] |'],
	lively => ['On# : BOOL; Count# : DINT;', '| NC On# | [ Count# := Count# + 1 ] | COIL On# |'],
	network => ['A# : INT := 3; B# : INT := 7; C# : INT; Out# : BOOL;', "Low := LT(A#, B#)\n  Sum := ADD(A#, B#)\n  Top := LIMIT(0, Sum, 100)\n"
		. "  C# := SEL(Low, Top, A#)\n  Big := GT(C#, 50)\n  Out# := AND(Big, NOT Low)"],
	network_ld => ['A# : INT := 3; B# : INT := 7; C# : INT; D# : INT; E# : INT; Low# : BOOL; Out# : BOOL;', '| LT IN1:=A# IN2:=B# | COIL Low# |'
		. "\nRUNG\n  | ADD IN1:=A# IN2:=B# OUT=>D# | LIMIT MN:=0 IN:=D# MX:=100 OUT=>E# | SEL G:=Low# IN0:=E# IN1:=A# OUT=>C# |"
		. "\nRUNG\n  | GT IN1:=C# IN2:=50 | NC Low# | COIL Out# |"],
	own => ['In# : BOOL := TRUE; Out# : BOOL; Own# : Latch;', '| NO In# | Latch Own# | COIL Out# |'],
);
my $latch = "FUNCTION_BLOCK Latch LD\nVAR_INPUT\n  Set : BOOL;\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL;\nEND_VAR\n"
	. "RUNG\n  | NO Set | COIL Q |\n  | NO Q  ^|\nEND_FUNCTION_BLOCK\n\n";

# The boxes of `mixed`, and product.
my @mixed = qw(ton ctu compare sum);
my %box = (
	ton => ['Delay# : TON;', 'TON Delay# PT:=T#1s'],
	ctu => ['Count# : CTU;', 'CTU Count# PV:=100'],
	compare => ['Level# : INT;', '[ Level# > 10 ]'],
	sum => ['Level# : INT; Sum# : INT;', 'ADD IN1:=Sum# IN2:=Level# OUT=>Sum#'],
	product => ['A# : REAL := 1.5; B# : REAL := 0.25; C# : REAL; D# : REAL;', 'MUL IN1:=A# IN2:=B# OUT=>C# | ADD IN1:=C# IN2:=D# OUT=>D#'],
);
sub box { my ($kind, $i) = @_; return $kind eq 'mixed' ? $mixed[$i & 3] : $box{$kind} ? $kind : undef }

my ($kind, $n) = @ARGV;
if (defined $kind && $kind eq 'families') {
	print join(' ', sort keys %family), "\n";
	exit;
}
die "usage: programs.pl seal|mixed|ton|ctu|compare|sum|product|dense|empty|chart|lines|blocks|parts|FAMILY N, or programs.pl families\n"
	unless defined $n && $n =~ /^\d+$/ && ($family{$kind} || $box{$kind} || $kind =~ /^(seal|mixed|dense|empty|chart|lines|blocks|parts)$/);
if ($family{$kind}) {
	my ($declared, $rung) = @{$family{$kind}};
	print "RUNGBOARD 1\n\n", $kind eq 'own' ? $latch : '', "VAR\n";
	print '  ', $declared =~ s/#(?=[^0-9F]|$)/$_/gr =~ s/; (?=\w)/;\n  /gr, "\n" for 0 .. $n - 1;
	print "END_VAR\n\nPROGRAM Main ", $kind eq 'network' ? "FBD\n" : "LD\n";
	print $kind eq 'network' ? 'NETWORK' : 'RUNG', "\n  ", $rung =~ s/(?<![0-9T])#|(?<=\bT)#(?=\[)/$_/gr, "\n" for 0 .. $n - 1;
	print "END_PROGRAM\n";
	exit;
}

# Ten lines of Structured Text, which use A, B and On with this number.
sub ten {
	my $lines = "  IF A# > B# AND NOT On# THEN\n    A# := A# + B# * 3;\n    On# := A# > 100;\n  ELSIF A# = 7 THEN\n"
		. "    B# := Scaled(A#);\n  ELSE\n    B# := B# + 1;\n  END_IF;\n";
	return $lines =~ s/#/$_[0]/gr;
}
sub ten_declared { return "  A#, B# : INT;\n  On# : BOOL;\n" =~ s/#/$_[0]/gr }
my $scaled = "FUNCTION Scaled : INT ST\nVAR_INPUT\n  X : INT;\nEND_VAR\n  Scaled := X * 2 + 1;\nEND_FUNCTION\n";
if ($kind eq 'lines') {
	my $parts = int($n / 10);
	print "RUNGBOARD 1\n\nPROGRAM Main ST\nVAR\n", (map { ten_declared($_) } 0 .. $parts - 1), "END_VAR\n",
		(map { ten($_) } 0 .. $parts - 1), "END_PROGRAM\n\n$scaled";
	exit;
}
if ($kind =~ /^(?:blocks|parts)$/) {
	my $tens = $kind eq 'parts' ? 1 : 10;
	my $blocks = int($n / 10 / $tens);
	print "RUNGBOARD 1\n\nPROGRAM Main ST\nVAR\n", (map { "  Part$_ : Block$_;\n" } 0 .. $blocks - 1), "END_VAR\n",
		(map { "  Part$_();\n" } 0 .. $blocks - 1), "END_PROGRAM\n\n$scaled";
	print "\nFUNCTION_BLOCK Block$_ ST\nVAR\n", (map { ten_declared($_) } 0 .. $tens - 1), "END_VAR\n",
		(map { ten($_) } 0 .. $tens - 1), "END_FUNCTION_BLOCK\n" for 0 .. $blocks - 1;
	exit;
}

# Bits: inputs and outputs, then variables without an address. `ladder bench` changes all inputs.
sub input { my ($i) = @_; return sprintf("AT %%IX%d.%d ", $i >> 3, $i & 7) }
sub output { my ($i) = @_; return $i < 4096 ? sprintf("AT %%QX%d.%d ", $i >> 3, $i & 7) : "" }

print "RUNGBOARD 1\n\n";
my $inputs = $kind eq 'seal' ? 2 * $n : box($kind, 0) ? $n : 0;
if ($inputs > 4096) {
	die "at most 65536 inputs\n" if $inputs > 65536;
	print "CONFIGURATION Large\n  AREA I ", ($inputs + 7) >> 3, ";\nEND_CONFIGURATION\n\n";
}
print "VAR\n";
if ($kind eq 'seal') {
	for my $i (0 .. $n - 1) {
		printf "  Start%d %s: BOOL;\n  Stop%d %s: BOOL;\n  Motor%d %s: BOOL;\n",
			$i, input(2 * $i), $i, input(2 * $i + 1), $i, output($i);
	}
} elsif (box($kind, 0)) {
	for my $i (0 .. $n - 1) {
		my $declared = $box{box($kind, $i)}[0] =~ s/#/$i/gr;
		printf "  In%d %s: BOOL;\n  Out%d %s: BOOL;\n  %s\n", $i, input($i), $i, output($i), $declared;
	}
} elsif ($kind eq 'dense') {
	printf "  In%d %s: BOOL;\n", $_, input($_) for 0 .. 63;
	printf "  Out%d %s: BOOL;\n", $_, output($_) for 0 .. $n - 1;
} elsif ($kind eq 'chart') {
	printf "  In%d %s: BOOL;\n", $_, input($_) for 0 .. 63;
	printf "  Out%d %s: BOOL;\n", $_, output($_) for 0 .. $n / 5 - 1;
} else {
	print "  A : BOOL;\n  B : BOOL;\n";
}
print "END_VAR\n\nPROGRAM Main ", $kind eq 'chart' ? "SFC\n" : "LD\n";

if ($kind eq 'chart') {
	my $per = 50;
	for my $i (0 .. $n - 1) {
		my $one = int($i / $per) * $per; # the first rung of its sequence
		my ($next, $over) = map { $one + ($i - $one + $_) % $per } 1, 3;
		my ($in, $else) = map { ($_ * 7 + 3) % 64 } $i, $i + 5;

		print $i == $one ? '  INITIAL_STEP' : '  STEP', " S$i:\n    Out", int($i / 5), "(N);\n  END_STEP\n\n";
		print "  TRANSITION FROM S$i TO S$next := In$in AND S$i.T >= T#20ms; END_TRANSITION\n\n";
		print "  TRANSITION FROM S$i TO S$over := In$else AND NOT In$in; END_TRANSITION\n\n" if $i % 5 == 0;
	}
} elsif ($kind eq 'dense') {
	for my $i (0 .. $n - 1) {
		print "RUNG\n";
		for my $row (0 .. 5) {
			print "  |";
			printf " %s In%d %s|", ($row + $_) & 1 ? "NO" : "NC", (7 * $i + 5 * $row + $_) & 63,
				$row && $_ < 7 ? "^" : " " for 0 .. 6;
			print $row ? "\n" : " COIL Out$i |\n";
		}
	}
} elsif ($kind eq 'seal') {
	print "RUNG\n  | NO Start$_  | NC Stop$_ | COIL Motor$_ |\n  | NO Motor$_ ^|\n" for 0 .. $n - 1;
} elsif (box($kind, 0)) {
	print "RUNG\n  | NO In$_ | ", $box{box($kind, $_)}[1] =~ s/(?<!T)#/$_/gr, " | COIL Out$_ |\n" for 0 .. $n - 1;
} else {
	print "RUNG\n  | NO A | COIL B |\n";
}
print "END_PROGRAM\n";
