#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# programs - writes the ladders that `make bench` measures: programs.pl KIND N
#
# seal:   N rungs of a start button, a stop button and a motor that seals in.
# mixed:  N rungs, by turns a timer, a counter, a comparison and arithmetic.
# dense:  N rungs of 8 x 6 contacts with a link at every cell.
# empty:  one rung, as little as there can be.
use strict;
use warnings;

my ($kind, $n) = @ARGV;
die "usage: programs.pl seal|mixed|dense|empty N\n"
	unless defined $n && $n =~ /^\d+$/ && $kind =~ /^(seal|mixed|dense|empty)$/;

# Bits: inputs while there are any, then markers, then plain variables.
sub input { my ($i) = @_; return $i < 4096 ? sprintf("AT %%IX%d.%d ", $i >> 3, $i & 7) : "" }
sub output { my ($i) = @_; return $i < 4096 ? sprintf("AT %%QX%d.%d ", $i >> 3, $i & 7) : "" }

print "RUNGBOARD 1\n\nVAR\n";
if ($kind eq 'seal') {
	for my $i (0 .. $n - 1) {
		printf "  Start%d %s: BOOL;\n  Stop%d %s: BOOL;\n  Motor%d %s: BOOL;\n",
			$i, input(2 * $i), $i, input(2 * $i + 1), $i, output($i);
	}
} elsif ($kind eq 'mixed') {
	for my $i (0 .. $n - 1) {
		my $k = $i & 3;
		printf "  In%d %s: BOOL;\n  Out%d %s: BOOL;\n", $i, input($i), $i, output($i);
		print "  Delay$i : TON;\n" if $k == 0;
		print "  Count$i : CTU;\n" if $k == 1;
		print "  Level$i : INT;\n" if $k >= 2;
		print "  Sum$i : INT;\n" if $k == 3;
	}
} elsif ($kind eq 'dense') {
	printf "  In%d %s: BOOL;\n", $_, input($_) for 0 .. 63;
	printf "  Out%d %s: BOOL;\n", $_, output($_) for 0 .. $n - 1;
} else {
	print "  A : BOOL;\n  B : BOOL;\n";
}
print "END_VAR\n\nPROGRAM Main LD\n";

if ($kind eq 'dense') {
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
} elsif ($kind eq 'mixed') {
	for my $i (0 .. $n - 1) {
		my $k = $i & 3;
		print "RUNG\n";
		print "  | NO In$i | TON Delay$i PT:=T#1s | COIL Out$i |\n" if $k == 0;
		print "  | NO In$i | CTU Count$i PV:=100 | COIL Out$i |\n" if $k == 1;
		print "  | NO In$i | [ Level$i > 10 ] | COIL Out$i |\n" if $k == 2;
		print "  | NO In$i | ADD IN1:=Sum$i IN2:=Level$i OUT=>Sum$i | COIL Out$i |\n" if $k == 3;
	}
} else {
	print "RUNG\n  | NO A | COIL B |\n";
}
print "END_PROGRAM\n";
