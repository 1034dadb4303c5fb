#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# samples.t - every program in ladders/ has no error, is canonical and passes its scenarios. The
# scenarios must notice nearly every contact that is inverted or bridged, and in a chart every
# changed condition and every line, priority, supervision and control that is left out. Samples
# are found by their names.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname basename);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $top = abs_path(dirname(__FILE__) . '/..');
my $build = abs_path($ENV{BUILD} // "$top/build");
my $ladder = $ENV{LADDER} ? abs_path($ENV{LADDER}) : "$build/ladder";
my $folder = tempdir(CLEANUP => 1);
my $noticed_least = 0.9; # interlocks that are made twice cannot be noticed
# Lines of a chart that are made twice, so that leaving out one is not noticed: how many,
# and in which sample.
my %twice = ('sequence-s0-s8' => 2); # S6 and S7 both reset Q0.5, as in the published chart

# An instruction with N added or removed.
sub broken_line {
	my ($i, @lines) = @_;
	my $was = $lines[$i];

	$lines[$i] =~ s/^(\s+)(LD|AND|OR|JMPC|RETC|CALC)(N?)(?= |$)/$1 . $2 . ($3 ? '' : 'N')/e
		or return;
	return { line => $i + 1, row => $was, text => join("\n", @lines) };
}

# The alternatives of a line of a chart; empty: without it.
sub broken_chart_line {
	my ($line) = @_;

	if (my ($before, $is) = $line =~ /^(\s+TRANSITION .* := )(.+)(?=; END_TRANSITION$)/) {
		my @else = $is eq 'TRUE' ? ('FALSE') : ("NOT ($is)", 'TRUE');
		my @all = map { "$before$_; END_TRANSITION" } @else;
		push @all, $line =~ s/\(PRIORITY := \d+\) //r;
		return grep { $_ ne $line } @all;
	}
	return ($line =~ s/\(PRIORITY := \d+\) //r) if $line =~ /^\s+TRANSITION .*\(PRIORITY/;
	return ('') if $line =~ /^\s+\w+\([A-Z].*\);$/ && $line !~ /^\s+CONTROL\(/;
	if (my ($word, $of) = $line =~ /^(\s+(?:CONTROL\(|SET |RESET ))(.+?)(?=\)?;$)/) {
		my @of = split /, /, $of;
		my $end = $word =~ /\($/ ? ');' : ';';
		return ('') if @of == 1;
		return map { my $not = $_; $word . join(', ', @of[grep { $_ != $not } 0 .. $#of]) . $end } 0 .. $#of;
	}
	return map { $line =~ s/\Q$_\E//r } $line =~ /(M(?:IN|AX) := [^,]+, )/g if $line =~ /\bSTEP \w+ \(/;
	return;
}

# The chart, changed once in each way.
sub broken_chart {
	my (@lines) = @_;
	my (@all, $in);

	for my $i (0 .. $#lines) {
		$in = 1 if $lines[$i] =~ /^PROGRAM \w+ SFC/;
		$in = 0 if $lines[$i] =~ /^END_PROGRAM/;
		next if !$in;
		for my $with (broken_chart_line($lines[$i])) {
			my @copy = @lines;
			$copy[$i] = $with;
			push @all, { line => $i + 1, row => "$lines[$i] -> $with", chart => 1,
				     text => join("\n", @copy) };
		}
	}
	return @all;
}

# The program with each contact changed once in each way.
sub broken {
	my ($text) = @_;
	my @lines = split /\n/, $text, -1;
	my %turned = (NO => 'NC', NC => 'NO');
	my @all = broken_chart(@lines);
	for my $i (0 .. $#lines) {
		push @all, broken_line($i, @lines);
		next if $lines[$i] !~ /^\s*\|/;
		while ($lines[$i] =~ /\| \K(NO|NC) [\w.%]+/g) {
			my ($word, $at, $end) = ($1, $-[0], $+[0]);
			for my $with ($turned{$word}
				      . substr($lines[$i], $at + 2, $end - $at - 2),
				      '---') {
				my @copy = @lines;
				substr($copy[$i], $at, $end - $at) = $with;
				push @all, { line => $i + 1, row => $copy[$i],
					     text => join("\n", @copy) };
			}
		}
	}
	return @all;
}

my ($made, $noticed) = (0, 0);
my @plants = glob("$top/ladders/*.plant.rung");
my @programs = grep { !/\.plant\.rung$/ } glob("$top/ladders/*.rung");
for my $program (@programs) {
	my $name = basename($program, '.rung');
	my $scenarios = $program =~ s/\.rung$/.scn/r;
	my ($status, $text) = answer('.', $ladder, 'check', $program);

	ok($status == 0 && $text !~ /warning|error/, "$name: good, no warning")
		or diag($text);
	($status, $text) = answer('.', $ladder, 'fmt', '--check', $program);
	is($status, 0, "$name: canonical") or diag($text);
	# The welcome page shows its first sentence.
	like(slurp($program) =~ s/\n\(\*.*//sr, qr/^[^;]*$/, "$name: a comment says what it is, before any declaration");
	($status, $text) = answer('.', $ladder, 'test', $scenarios);
	is($status, 0, "$name: does what its scenarios say") or diag($text);
	my $count = () = $text =~ /^ok /mg;
	cmp_ok($count, '>=', 3, "$name: has scenarios");

	my $plant = $program =~ s/\.rung$/.plant.rung/r;
	spew("$folder/$name.plant.rung", slurp($plant)) if -e $plant;
	spew("$folder/$name.scn", slurp($scenarios));
	my (@missed, @missed_chart);
	my $of = 0;
	for my $broken (broken(slurp($program))) {
		spew("$folder/$name.rung", $broken->{text});
		($status, $text) = answer('.', $ladder, 'test', '--fail-fast', "$folder/$name.scn");
		next if $text =~ /^not ok 1 - .*: its program is good$/m; # it is not a program any more
		$of++;
		next if $status;
		push @missed, "$broken->{line}: $broken->{row}";
		push @missed_chart, $missed[-1] if $broken->{chart};
	}
	is(scalar @missed_chart, $twice{$name} // 0, "$name: its scenarios notice every change of the chart")
		or diag(join "\n", @missed_chart) if slurp($program) =~ /^PROGRAM \w+ SFC/m;
	$made += $of;
	$noticed += $of - @missed;
	cmp_ok(@missed, '<', $of / 2, "$name: its scenarios notice broken contacts")
		or diag(join "\n", @missed);
}
for my $plant (@plants) {
	my $name = basename($plant, '.rung');
	my ($status, $text) = answer('.', $ladder, 'check', $plant);

	ok($status == 0 && $text !~ /warning|error/, "$name: good, no warning")
		or diag($text);
	($status, $text) = answer('.', $ladder, 'fmt', '--check', $plant);
	is($status, 0, "$name: canonical") or diag($text);
	my $scenarios = $plant =~ s/\.plant\.rung$/.scn/r;
	like(slurp($scenarios), qr/^\s*plant "\Q$name.rung\E"/m, "$name: a scenario is beside it");

	# A plant that does not move is noticed.
	my $other = basename($scenarios, '.scn');
	my $still = slurp($plant) =~ s/^RUNG\b/RUNG OFF/mgr;
	spew("$folder/$_", slurp("$top/ladders/$_"))
		for "$other.rung", "$other.scn";
	spew("$folder/$name.rung", $still);
	($status, $text) = answer('.', $ladder, 'test', "$folder/$other.scn");
	isnt($status, 0, "$name: it matters what it does");
	unlike($text, qr/ error LD\d/, "$name: and it is not the file") or diag($text);
}
cmp_ok(@plants, '>=', 3, 'samples with a plant');
cmp_ok(@programs, '>=', 8, 'the samples were found');
cmp_ok($noticed, '>=', $noticed_least * $made,
       "broken contacts are noticed: $noticed of $made");
done_testing();
