#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# starts - starts.pl BUILD PROGRAM: what a user waits for, as a row of a table. Medians of the whole process, from its start
# to its end: `ladder check`, and `ladderd` with one scan; and the memory that a running `ladderd` has.
use strict;
use warnings;
use File::Temp 'tempdir';
use Time::HiRes qw(time sleep);

my ($build, $program) = @ARGV;
my $map = tempdir(CLEANUP => 1) . '/desk.io';
open my $out, '>', $map or die "$map: $!\n";
print $out "BOARD \"desk\"\n";
close $out;

sub start {
	my (@command) = @_;
	my $pid = fork // die "fork: $!\n";
	if (!$pid) {
		open STDOUT, '>', '/dev/null';
		open STDERR, '>', '/dev/null';
		exec @command or die "$command[0]: $!\n";
	}
	return $pid;
}

# Milliseconds.
sub took {
	my (@command) = @_;
	my @took;
	for (1 .. 9) {
		my $begin = time;
		waitpid start(@command), 0;
		push @took, 1000 * (time - $begin);
	}
	return (sort { $a <=> $b } @took)[4];
}

# KB that are in memory while it scans, when they grow no more.
sub resident {
	my $pid = start("$build/ladderd", $program, '--io', $map);
	my $kb = 0;
	for (my $before = -1; $kb != $before || !$kb;) {
		($before) = ($kb);
		sleep 0.3;
		open my $in, '<', "/proc/$pid/status" or last;
		($kb) = map { /^VmRSS:\s+(\d+)/ ? $1 : () } <$in>;
		$kb //= 0;
	}
	kill 'TERM', $pid;
	waitpid $pid, 0;
	return $kb;
}

printf "%.1f | %.1f | %d", took("$build/ladder", 'check', $program),
	took("$build/ladderd", $program, '--io', $map, '--scans', 1), resident();
