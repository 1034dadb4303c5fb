# SPDX-License-Identifier: MIT
#
# Terminal - runs a program on a terminal that script(1) makes. A key is pressed when the screen shows what it waits for.
package Terminal;
use strict;
use warnings;
use Exporter 'import';
use IPC::Open2;
use Limit;
our @EXPORT = qw(has_terminal on_terminal);

sub has_terminal { return scalar grep { -x "$_/script" } split /:/, $ENV{PATH} }

# @steps: pairs of what the screen shows since the step before, and a key or a function. Returns the exit status and all
# that was shown.
sub on_terminal {
	my ($rows, $columns, $command, @steps) = @_;
	local @ENV{qw(NO_COLOR TERM LC_ALL)} = (1, 'xterm', 'C');
	my $pid = open2(my $from, my $to, 'script', '-qec', "stty cols $columns rows $rows; $command", '/dev/null');
	my ($screen, $seen) = ('', 0);
	my $more = sub {
		my $ready = '';
		vec($ready, fileno $from, 1) = 1;
		return 0 if !select $ready, undef, undef, 0.02;
		return !sysread $from, $screen, 65536, length $screen;
	};
	while (my ($wanted, $act) = splice @steps, 0, 2) {
		until_true(sub { return substr($screen, $seen) =~ $wanted || ($more->() && die "it ended: $screen") });
		$seen = length $screen;
		ref $act ? $act->() : syswrite $to, $act;
	}
	until_true($more);
	return (finish($pid), $screen);
}

1;
