#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# fbd_flow.t - random networks in FBD do what a second evaluator says (tests/fbd/FbdFlow.pm), which walks them as
# data flow with a parser of its own. FBD_SEEDS=1..800 runs these programs, of 25 networks each.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__)), abs_path(dirname(__FILE__)) . '/fbd';
use Files;
use FbdFlow;
use FbdRandom;

my $tests = abs_path(dirname(__FILE__));
my $ladder = abs_path($ENV{LADDER} || ($ENV{BUILD} // "$tests/../build") . '/ladder');
my ($first, $last) = ($ENV{FBD_SEEDS} // '1..40') =~ /(\d+)\.\.(\d+)/;
my $networks = 25;
my $scans = 12;
my $dir = tempdir(CLEANUP => 1);
my %same = (lines => 0, values => 0);

sub shown {
	my ($type, $value) = @_;
	return $type eq 'STRING' ? "'$value'" : $value;
}

for my $seed ($first .. $last) {
	my $text = FbdRandom::program($seed, $networks);
	my @names = FbdRandom::names();
	my $stimulus = '@print ' . join(' ', map { "Main.$_->[0]" } @names) . "\n";
	my $pous = FbdFlow::parse($text);
	my $main = FbdFlow::new_instance($pous, 'Main');
	my @want;
	for my $scan (1 .. $scans) {
		my @set = FbdRandom::inputs();
		my %last = map { $_->[0] => $_->[1] } @set;
		$stimulus .= join(' ', map { "Main.$_=$last{$_}" } sort keys %last) . "\n";
		$main->{value}{$_} = $last{$_} =~ /^'(.*)'$/ ? $1 : 0 + $last{$_} for keys %last;
		FbdFlow::run_pou($pous, $main, $scan * 10);
		push @want, {%{$main->{value}}};
	}
	spew("$dir/main.rung", $text);
	spew("$dir/stimulus", $stimulus);
	my $said = `cd '$dir' && '$ladder' trace main.rung stimulus 2>said`;
	my @got = split /\n/, $said;
	my $wrong = @got == $scans ? '' : join '', grep { /error/ } split /^/, slurp("$dir/said");
	for my $scan (1 .. $scans) {
		my %is = ($got[$scan - 1] // '') =~ /Main\.(\w+)=('[^']*'|\S+)/g;
		for (@names) {
			my ($name, $type) = @$_;
			my $want = shown($type, $want[$scan - 1]{$name});
			my $is = $is{$name} // 'nothing';
			$same{values}++;
			next if $type eq 'REAL' ? $is =~ /^[-\d.e+]+$/ && FbdFlow::float($is) == $want : $is eq $want;
			$wrong ||= "scan $scan: $name is $is, not $want";
		}
	}
	$same{lines}++ while $text =~ /^  \w+.* [:SR]=/mg;
	next if $wrong eq '';
	fail("program $seed");
	diag($wrong);
	spew($ENV{FBD_KEEP}, $text), spew("$ENV{FBD_KEEP}.stimulus", $stimulus) if $ENV{FBD_KEEP};
	last if $ENV{FBD_KEEP};
}
cmp_ok($same{lines}, '>', 50 * ($last - $first + 1), "$same{lines} lines, $same{values} values");
done_testing();
