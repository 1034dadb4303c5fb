#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# classic.t - ClassicLadder projects do the same here as in ClassicLadder.
#
# tests/classic/projects/ holds every element, member and dialect: a project, its script, and
# the trace of the second evaluator (NAME.trace; NAME.faithful.trace if ClassicLadder's faults
# change it). With SAMPLES=DIR each project in DIR and DIR/classicladder must give the *.trace
# beside it that was recorded from ClassicLadder, except where one of the faults below plays a
# part. --write writes the traces of tests/classic/projects again: read the difference.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(basename dirname);
use Test::More;

use lib dirname(abs_path(__FILE__));
use ClassicTest;

chdir dirname(abs_path(__FILE__)) . '/..' or die;
my $build = $ENV{BUILD} || 'build';
my $ladder = $ENV{LADDER} || "$build/ladder";
my $second = "$build/tests/bin/classic_trace";
my $ours = 'tests/classic/projects';

# Recorded traces that a repaired project does not give: the reason, and the first line of the
# recorded trace that differs. --faithful must give all of it.
my %fault = (
	'3pumps.a' => ['F1: a TON interrupted before fires early', '280 t=14000 '],
	'adam-6051.a' => ['F1: a TON interrupted before fires early', '111 t=5550 '],
	'adam-6051.b' => ['F1: a TON interrupted before fires early', '255 t=12750 '],
	'example.b' => ['F1: a TP that was run before ends early', '281 t=14050 '],
	'unit-05_iec' => ['F1: a TON interrupted before fires early', '99 t=9900 '],
);
# Recorded traces that --faithful does not give either, and why.
my %never = (
	'924-lc.a' => ['the script prints bits that this project does not have: other memory', '1 t=1 '],
	'924-lc.b' => ['the script prints bits that this project does not have: other memory', '1 t=1 '],
);
# The same for tests/classic/projects, with --faithful.
my %ours_never = (
	'ring' => ['F6: a register that writes into another one is not repeated', '13 t=1300 '],
);

# The first line of the wanted text that differs; undef: both texts are the same.
sub first_difference {
	my ($got, $want) = @_;
	my @got = split /\n/, $got, -1;
	my @want = split /\n/, $want, -1;
	for my $i (0 .. $#want) {
		return $want[$i] if $i > $#got || $got[$i] ne $want[$i];
	}
	return @got > @want ? 'the end' : undef;
}

# The same text, or with a reason a text that differs from a known line on.
sub same {
	my ($what, $got, $want, $reason) = @_;
	my $line = first_difference($got, $want);
	if (!$reason) {
		ok(!defined $line, $what) or diag("first line that differs, as wanted: $line");
	} else {
		ok(defined $line && index($line, $reason->[1]) == 0, "$what: not from $reason->[1]on ($reason->[0])")
			or diag(defined $line ? "differs at: $line" : 'it is the same');
	}
}

sub test_ours {
	for my $script (sort glob("$ours/*.script")) {
		my $base = $script =~ s/\.script$//r;
		my $name = basename($base);
		my $project = project_of($base);
		my $want = slurp("$base.trace");
		my $faithful = slurp("$base.faithful.trace");
		$faithful = $want unless defined $faithful;
		same("$name: the second evaluator", run($second, '--changes', $project, $script), $want);
		same("$name: the same, faithful", run($second, '--faithful', '--changes', $project, $script), $faithful);
		same($name, run($ladder, 'trace', '--changes', $project, $script), $want);
		same("$name, faithful", run($ladder, 'trace', '--faithful', '--changes', $project, $script),
			$faithful, $ours_never{$name});
	}
}

sub test_recorded {
	my ($folder) = @_;
	for my $trace (sort glob("$folder/*.trace")) {
		my $name = basename($trace) =~ s/\.trace$//r;
		my $script = "$folder/$name.script";
		my $changes = $name =~ /\.[ab]$/ ? 1 : 0;
		my $project = project_of("$folder/" . $name =~ s/\.[ab]$//r);
		my @how = $changes ? ('--changes') : ();
		my $want = slurp($trace);
		same("recorded $name: the second evaluator",
			run($second, '--faithful', '--upstream', @how, $project, $script), $want);
		same("recorded $name, faithful", run($ladder, 'trace', '--faithful', @how, $project, $script),
			$want, $never{$name});
		same("recorded $name", run($ladder, 'trace', @how, $project, $script), $want,
			$never{$name} || $fault{$name});
	}
}

sub write_ours {
	for my $script (sort glob("$ours/*.script")) {
		my $base = $script =~ s/\.script$//r;
		my $project = project_of($base);
		my %text = map { $_ => run($second, $_ ? '--faithful' : (), '--changes', $project, $script) } 0, 1;
		my @to = (["$base.trace", $text{0}]);
		push @to, ["$base.faithful.trace", $text{1}] if $text{1} ne $text{0};
		for my $file (@to) {
			open my $out, '>:raw', $file->[0] or die "$file->[0]: $!\n";
			print $out $file->[1];
			close $out or die "$file->[0]: $!\n";
		}
		unlink "$base.faithful.trace" if $text{1} eq $text{0};
	}
	exit 0;
}

write_ours() if @ARGV && $ARGV[0] eq '--write';
test_ours();
if ($ENV{SAMPLES}) {
	my @folders = grep { my @any = glob("$_/*.clp*"); @any } $ENV{SAMPLES}, "$ENV{SAMPLES}/classicladder";
	ok(scalar @folders, "ClassicLadder projects in $ENV{SAMPLES}");
	test_recorded($_) for @folders;
}
done_testing();
