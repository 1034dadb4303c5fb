#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# convert_space.t - random projects (RandomProject.pm) in all five languages do the same as Structured Text, networks,
# ladders and lists. What cannot be converted is refused with its place.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;
use RandomProject;

my $tests = abs_path(dirname(__FILE__));
my $build = abs_path($ENV{BUILD} // "$tests/../build");
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);
chdir $folder or die;

sub first_difference {
	my @a = split /\n/, $_[0];
	my @b = split /\n/, $_[1];
	for (0 .. ($#a > $#b ? $#a : $#b)) {
		return "was: " . ($a[$_] // '-') . "\nis:  " . ($b[$_] // '-') if ($a[$_] // '') ne ($b[$_] // '');
	}
	return '';
}
sub traced { return scalar `$ladder trace $_[0] script 2>&1` =~ s/^.*: (?:warning|hint).*\n//gmr }

my (@wrong, %done, %refused);
my $projects = $ENV{PROJECTS} // 40;
for my $seed ($ENV{SEED} // 1 .. $projects) {
	srand $seed;
	my ($text, $all) = RandomProject::project();
	spew('one.rung', $text);
	next if system("$ladder check one.rung >trouble 2>&1");
	if ($text =~ /^PROGRAM (\w+) SFC/m) { # its variables are global ones in a ladder
		my $chart = $1;
		delete @$all{grep { /^$chart\./ } keys %$all};
	}
	spew('script', RandomProject::script($all, 30));
	my $was = traced('one.rung');
	push @wrong, "$seed: $was" if $was !~ /^1 t=/;
	for my $as ($ENV{AS} // qw(st fbd ld il)) {
		my $said = `$ladder export --as $as one.rung -o two.rung 2>&1`;
		if ($?) {
			$refused{"$as $1"}++ if $said =~ /^one\.rung:\d+:.*error (LD78\d|LD460)/m;
			push @wrong, "$seed as $as: $said" if $said !~ /^one\.rung:\d+:.*error LD(?:78\d|460)/m;
			next;
		}
		$done{$as}++;
		my $is = traced('two.rung');
		next if $is eq $was;
		push @wrong, "$seed as $as: " . first_difference($was, $is);
		diag(slurp('one.rung') . slurp('two.rung')) if $ENV{SEED};
	}
}
is(scalar @wrong, 0, "$projects random projects: " . join(', ', map { "$done{$_} as $_" } sort keys %done) . '; refused: ' . join(', ', map { "$refused{$_} $_" } sort keys %refused)) or
	diag(join "\n", map { substr $_, 0, 900 } @wrong);
cmp_ok($done{$_} // 0, '>', $projects / 8, "many become $_") for $ENV{SEED} ? () : qw(st fbd ld il);
done_testing;
