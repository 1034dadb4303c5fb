# SPDX-License-Identifier: MIT
#
# Limit - a test that would hang ends within a minute with "not ok" instead, and so do the programs that it
# has started. That is so for each wait with until_true() or finish(), and for all else that a test does: after a
# minute without a result, in which its programs did not compute either, it is over. Slow machines only make a test slow.
package Limit;
use strict;
use warnings;
use Exporter 'import';
use POSIX qw(:sys_wait_h);
use Test2::API qw(test2_stack);
use Test::More ();
use Time::HiRes qw(sleep clock_gettime CLOCK_MONOTONIC);
our @EXPORT = qw(until_true finish);
our @show; # files whose last lines tell why

use constant { PATIENCE => 50, COMPUTES => 250 }; # s; hundredths of a second of processor time in that

# All processes that this one has started, and theirs; and the time that all have computed, in hundredths of a second.
sub family {
	my (%of, %used, @all);
	for my $folder (glob '/proc/[0-9]*') {
		open my $file, '<', "$folder/stat" or next;
		my ($pid, $rest) = (<$file> // '') =~ /^(\d+) .*\) \S (.*)/ or next;
		my @field = split ' ', $rest;
		push @{$of{$field[0]}}, $pid;
		$used{$pid} = $field[10] + $field[11] + $field[12] + $field[13];
	}
	my $used = $used{$$} // 0;
	for (my @next = @{$of{$$} // []}; defined(my $pid = shift @next); push @next, @{$of{$pid} // []}) {
		push @all, $pid;
		$used += $used{$pid};
	}
	return ($used, @all);
}

# Ends the test. Its END blocks are run.
sub stop {
	my ($what) = @_;
	my (undef, @all) = family();
	alarm 0;
	Test::More::fail($what);
	for my $path (@show) {
		open my $file, '<', $path or next;
		my @lines = <$file>;
		Test::More::diag($path =~ s{.*/}{}r, ":\n", @lines > 10 ? @lines[-10 .. -1] : @lines);
	}
	kill 'CONT', @all;
	kill 'KILL', @all;
	exit 1;
}

# The lines of the test that led here.
sub place {
	my @at = grep { @$_ && $_->[1] !~ /\.pm$/ } map { [caller $_] } 1 .. 9;
	return join ' ', $0, map { "line $_->[2]" } reverse @at;
}

# Waits until a condition holds.
sub until_true {
	my ($check) = @_;
	my $end = clock_gettime(CLOCK_MONOTONIC) + PATIENCE;
	for (my $tries = 0; !$check->(); $tries++) {
		stop('what ' . place() . ' waits for did not happen within ' . PATIENCE . ' s') if clock_gettime(CLOCK_MONOTONIC) > $end;
		sleep $tries < 100 ? 0.002 : 0.02;
	}
	alarm PATIENCE;
	return 1;
}

# Waits until a program ends: its exit status, or "signal N".
sub finish {
	my ($pid) = @_;
	until_true(sub { waitpid($pid, WNOHANG) == $pid });
	return $? & 127 ? 'signal ' . ($? & 127) : $? >> 8;
}

# ---- all else ----
my ($own, $before) = ($$, 0);
sub look {
	return if $$ != $own; # a copy of this process, by fork
	my ($used) = family();
	stop('there was no result within ' . PATIENCE . ' s, and nothing computed') if $used - $before < COMPUTES;
	$before = $used;
	alarm PATIENCE;
}
$SIG{ALRM} = \&look;
test2_stack()->top->listen(sub { alarm PATIENCE if $$ == $own });
alarm PATIENCE;

1;
