#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# sfc_in_blocks.t - the chart of a FUNCTION_BLOCK does what the same chart of a PROGRAM does, in each of its instances.
#
# The charts of golden cases become blocks with several instances, of which one is called. Variables
# with addresses become globals. What a trace shows of the first instance must be what it showed of the program, and
# the other instances must stay as they were.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(dirname);
use File::Temp qw(tempdir);
use Test::More;
use lib abs_path(dirname(__FILE__));
use Files;

my $tests = abs_path(dirname(__FILE__));
my $ladder = abs_path($ENV{LADDER} // ($ENV{BUILD} // "$tests/../build") . '/ladder');
my $dir = tempdir(CLEANUP => 1);
my @cases = (map { "sfc-$_" } qw(qualifier-D qualifier-DS qualifier-L qualifier-SD qualifier-SL qualifier-P0 qualifier-P1
	qualifier-R two-body-SD two-bool-DS two-st-S control-all-macro control-force-simultaneous control-hold-loop
	control-manual-macro control-reset-selective control-semi-priority order-simultaneous order-loop stable-loop
	in-order in-stable final-scan supervision-macro two-simultaneous-macro two-rings wanted-by-two-priority
	conditions macro-in-macro set-and-reset structure-jump));

# The values of each scan, by name.
sub scans {
	my ($file, $stimulus) = @_;
	my ($status, $text) = answer($dir, $ladder, 'trace', $file, $stimulus);
	return undef if $status;
	return [map { { /(\S+)=('(?:[^'\$]|\$.)*'|\S+)/g } } grep { /^\d+ t=/ } split /\n/, $text];
}

for my $case (@cases) {
	my $text = slurp("$tests/golden/$case/main.rung");
	my ($before, $vars, $body, $after) =
		$text =~ /\A(.*?)^PROGRAM \w+ (SFC[^\n]*\n)(.*?)^END_PROGRAM\n(.*)\z/ms or BAIL_OUT("$case is no chart");
	my $globals = '';
	$globals .= $1 while $body =~ s/^(\s+\w+ +AT %[^\n]*;[^\n]*\n)//m;
	$globals = "VAR_GLOBAL\n${globals}END_VAR\n\n";
	my $stimulus = slurp("$tests/golden/$case/stimulus");
	$stimulus =~ s/^\@print.*\n//mg;
	spew("$dir/stimulus", $stimulus);
	spew("$dir/program.rung", "$before${globals}PROGRAM Chart $vars${body}END_PROGRAM\n$after");
	spew("$dir/block.rung", "$before${globals}FUNCTION_BLOCK Chart $vars${body}END_FUNCTION_BLOCK\n$after\n" .
	     "PROGRAM Main ST\nVAR\n  M : Chart;\n  Unused : ARRAY[1..2] OF Chart;\n  Scans : INT;\nEND_VAR\n" .
	     "  M();\n  Scans := Scans + 1;\nEND_PROGRAM\n");
	my ($program, $block) = (scans('program.rung', 'stimulus'), scans('block.rung', 'stimulus'));
	ok($program && @$program > 3, "$case: runs as a program") or next;
	ok($block, "$case: runs as a block") or next;
	is(scalar(@$block), scalar(@$program), "$case: as many scans");
	my (@wrong, $same, @touched);
	for my $i (0 .. $#$program) {
		for my $name (sort keys %{$program->[$i]}) {
			my $value = $block->[$i]{"M.$name"} // $block->[$i]{$name};
			next if !defined $value;
			$same++;
			push @wrong, "scan " . ($i + 1) . ": $name" if $value ne $program->[$i]{$name};
		}
		push @touched, grep { /^Unused/ && $block->[$i]{$_} ne $block->[0]{$_} } keys %{$block->[$i]};
	}
	is("@wrong[0 .. ($#wrong < 4 ? $#wrong : 4)]", '', "$case: the same values ($same)");
	cmp_ok($same, '>', 3 * @$program, "$case: values were compared");
	is("@touched", '', "$case: the other instances stay as they were");
}
done_testing();
