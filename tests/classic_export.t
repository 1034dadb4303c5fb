#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# classic_export.t - projects go back to ClassicLadder, and run there as they run here.
#
# Each project of tests/classic/projects/ is exported; what comes out gives the trace of the
# original, here and in the second evaluator, which reads the file itself. Random projects
# the same, and ladders that were never ClassicLadder's: they keep their own trace. What
# cannot be said there writes nothing.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(basename dirname);
use File::Temp qw(tempdir);
use Test::More;

chdir dirname(abs_path(__FILE__)) . '/..' or die;
my $build = $ENV{BUILD} || 'build';
my $ladder = $ENV{LADDER} || "$build/ladder";
my $second = "$build/tests/bin/classic_trace";
my $random = "$build/tests/bin/classic_random";
my $ours = 'tests/classic/projects';
my $dir = tempdir(CLEANUP => 1);

sub run {
	my (@command) = @_;
	open my $out, '-|', 'sh', '-c', 'exec "$@" 2>/dev/null', 'sh', @command
		or return "cannot run $command[0]\n";
	binmode $out;
	local $/;
	my $text = <$out>;
	close $out;
	$text = '' unless defined $text;
	$text .= "exit status " . ($? >> 8) . "\n" if $?;
	return $text;
}

sub slurp {
	my ($path) = @_;
	open my $in, '<:raw', $path or return undef;
	local $/;
	my $text = <$in>;
	return $text;
}

sub project_of {
	my ($base) = @_;
	for my $end ('.clp', '.clprj', '.clprjz', '.txt', '') {
		return "$base$end" if -e "$base$end";
	}
	return undef;
}

# The export as a file; undef: it was refused.
sub export {
	my ($project, $as, $name) = @_;
	my $out = "$dir/$name.clprj";
	unlink $out;
	run($ladder, 'export', '--as', $as, $project, '-o', $out);
	return -e $out ? $out : undef;
}

# No member is empty, no line longer than a reader's buffer.
sub well_formed {
	my ($what, $text) = @_;
	my @long = grep { length > 298 } split /\n/, $text;
	ok($text !~ m{_FILE-[^\n]*\n_/FILE-} && !@long, "$what: no empty member, no long line");
}

sub same_trace {
	my ($what, $project, $script, $out) = @_;
	my $want = run($ladder, 'trace', '--changes', $project, $script);
	is(run($ladder, 'trace', '--changes', $out, $script), $want, "$what: the same trace");
	is(run($second, '--changes', $out, $script), run($second, '--changes', $project, $script),
		"$what: the second evaluator");
}

# Which dialect cannot hold what a project has.
my %cannot = (
	'classicladder crlf' => 1, 'classicladder linuxcnc' => 1, # numbers with a point
);

for my $script (sort glob("$ours/*.script")) {
	my $base = $script =~ s/\.script$//r;
	my $name = basename($base);
	my $project = project_of($base);
	my $as = $cannot{"classicladder $name"} ? 'linuxcnc' : 'classicladder';
	my $out = export($project, $as, $name);
	ok(defined $out, "$name as $as") or next;
	well_formed($name, slurp($out));
	same_trace($name, $project, $script, $out);
}
for my $seed (1 .. 25) {
	run($random, $seed, "$dir/r$seed");
	my $out = export("$dir/r$seed.clprj", 'classicladder', "out$seed");
	next unless defined $out;
	same_trace("seed $seed", "$dir/r$seed.clprj", "$dir/r$seed.script", $out);
}
{
	my $out = export("$ours/numeric.txt", 'numeric', 'numeric');
	my $again = defined $out ? export($out, 'numeric', 'again') : undef;
	is(defined $again ? slurp($again) : '', defined $out ? slurp($out) : 'none',
		'numeric: the second text is the first');
	same_trace('numeric', "$ours/numeric.txt", "$ours/numeric.script", $out) if defined $out;
}
done_testing();
