#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# coverage.pl BUILD - how many lines and branches of each folder the tests have run, by gcov and gcovr.
# `make coverage` builds with --coverage, runs the tests and calls this.
use strict;
use warnings;
use JSON::PP;

my $build = shift // 'build';
my $folders = '(?:runtime|hal|editor-gtk)/.*\.[ch]$';
my $file = "$build/coverage.json";
system("gcovr -j 2 --gcov-ignore-parse-errors -r . --filter '$folders' --json-summary $file $build/runtime $build/hal $build/editor-gtk $build/tests/hal") == 0 or
	die "coverage.pl: gcovr has no report of $build\n";
open my $in, '<', $file or die "$file: $!\n";
my $json = do { local $/; <$in> };
my %sum;

for my $one (@{ decode_json($json)->{files} }) {
	my $name = $one->{filename};
	my %room = map { $_ => 1 } 'all', $name =~ m{^([^/]+)/}, $name =~ m{^(.+)/[^/]+$};

	for my $room (keys %room) {
		$sum{$room}{$_} += $one->{$_} for qw(line_total line_covered branch_total branch_covered);
	}
}
sub share { my ($of, $all) = @_; return $all ? sprintf '%5.1f %%', 100 * $of / $all : '      -'; }
printf "%-36s %7s %8s %9s %9s\n", 'folder', 'lines', 'of them', 'branches', 'of them';
for my $room (sort { ($a eq 'all') <=> ($b eq 'all') || $a cmp $b } keys %sum) {
	my $s = $sum{$room};

	printf "%-36s %7d %8s %9d %9s\n", $room, $s->{line_total}, share($s->{line_covered}, $s->{line_total}),
		$s->{branch_total}, share($s->{branch_covered}, $s->{branch_total});
}
