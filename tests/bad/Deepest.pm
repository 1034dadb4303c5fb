# SPDX-License-Identifier: MIT
#
# Deepest.pm - programs nested to the limits of limits.h, and deeper: "bad-deepest", which
# runs, and for a table the message about one level more of each kind.
package Deepest;
use strict;
use warnings;

# Each kind for a given depth: types, variables, POUs besides Main, rungs of Main.
my %kinds = (
	EXPR_DEPTH => sub { my ($n) = @_;
		return ('', '  Expr : INT;', '',
			'| [ Expr := ' . '(' x $n . 'Expr + 1' . ')' x $n . ' ] |') },
	LOOPS => sub { my ($n) = @_;
		return ('', join("\n", '  Rounds : INT;', map { "  i$_ : INT;" } 1 .. $n), '',
			(map { "| FOR i$_ := 1 TO 2 |" } 1 .. $n), '| [ Rounds := Rounds + 1 ] |',
			('| NEXT |') x $n) },
	IL_DEPTH => sub { my ($n) = @_;
		return ('', '  List : BOOL;', "\nSUBROUTINE Lists IL\n  LD TRUE\n" . "  AND( TRUE\n" x $n .
			"  )\n" x $n . "  ST List\nEND_SUBROUTINE\n", '| CALL Lists |') },
	CALLS => sub { my ($n) = @_; # Main is not counted
		return ('', '  Calls : INT;', join('', map { "\nSUBROUTINE Sub$_ LD\nRUNG\n  | " .
			($_ < $n ? 'CALL Sub' . ($_ + 1) : '[ Calls := Calls + 1 ]') .
			" |\nEND_SUBROUTINE\n" } 1 .. $n), '| CALL Sub1 |') },
	NESTING => sub { my ($n) = @_;
		return (join('', "TYPE\n", (map { my $in = $_ == 1 ? 'INT' : 'D' . ($_ - 1);
			"  D$_ : STRUCT\n    X : $in;\n  END_STRUCT;\n" } 1 .. $n), "END_TYPE\n\n"),
			"  Deep : D$n;\n  Nested : INT;", '',
			"| [ Deep" . '.X' x $n . " := 7 ] | [ Nested := Deep" . '.X' x $n . " ] |") },
	FN_INPUTS => sub { my ($n) = @_;
		return ('', '  Sum : INT;', '', '| ADD ' . join(' ', map { "IN$_:=$_" } 1 .. $n) .
			' OUT=>Sum |') },
	COLS => sub { my ($n) = @_;
		return ('', '  Wide : BOOL;', '', '| NO SYS_ALWAYS_ON ' x ($n - 1) . '| COIL Wide |') },
	ROWS => sub { my ($n) = @_;
		return ('', "  Last : BOOL;\n  Never : BOOL;", '', join "\n  ",
			'| NO Never | COIL Last |', ('| NO Never ^|') x ($n - 2), '| NC Never ^|') },
);

sub program {
	my (%limits) = @_;
	my ($types, $declared, $pous, $rungs) = ('') x 4;
	for my $kind (sort keys %limits) {
		my ($type, $var, $pou, @rungs) = $kinds{$kind}->($limits{$kind});
		$types .= $type;
		$declared .= "$var\n";
		$pous .= $pou;
		$rungs .= join '', map { "RUNG\n  $_\n" } @rungs;
	}
	return "RUNGBOARD 1\nPROJECT \"As deep as it may be\"\n\n${types}VAR\n${declared}END_VAR\n\n" .
		"PROGRAM Main LD\n${rungs}END_PROGRAM\n$pous";
}

sub limits {
	my ($path) = @_;
	my %limits;
	open my $in, '<', $path or die "$path: $!";
	while (<$in>) {
		$limits{$1} = $2 if /^#define LIMIT_(\w+)\s+(\d+)\s/ && $kinds{$1};
	}
	return %limits;
}

1;
