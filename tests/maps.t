#!/usr/bin/perl
# SPDX-License-Identifier: MIT
#
# maps.t - the I/O maps of boards, of the samples and of the documents can be read: whatever is wrong with
# them on this machine is a chip or a device that it does not have. The overlay in docs/field.md compiles.
use strict;
use warnings;
use Cwd qw(abs_path);
use File::Basename qw(basename dirname);
use File::Temp qw(tempdir);
use JSON::PP;
use Test::More;
use lib abs_path(dirname(__FILE__));
use Limit ();

my $top = dirname(dirname(abs_path(__FILE__)));
my $build = $ENV{BUILD} // "$top/build";
my $ladder = abs_path($ENV{LADDER} // "$build/ladder");
my $folder = tempdir(CLEANUP => 1);
my %not_here = map { $_ => 1 } qw(LD508 LD509 LD510 LD511 LD512 LD513 LD516 LD525 LD550 LD551 LD552 LD553 LD554 LD555 LD556 LD557 LD558 LD559
	LD560 LD561 LD562 LD563 LD564 LD565 LD566 LD567 LD568 LD875);
my %text;

sub slurp {
	my ($path) = @_;
	open my $file, '<:raw', $path or die "$path: $!";
	local $/;
	return <$file>;
}

sub errors_of {
	my ($path) = @_;
	my $json = `$ladder io --json '$path' 2>&1`;
	my $said = eval { decode_json($json) } or return $json;
	ok(@{$said->{points}} || slurp($path) =~ /^SERVE/m, basename($path) . ': has points') or diag $json;
	return join ' ', map "$_->{code}:$_->{line}", grep { !$not_here{$_->{code}} } @{$said->{diagnostics}};
}

for my $document (glob "$top/docs/*.md") {
	my $in = slurp($document);
	while ($in =~ /^```text (\S+\.(?:io|dts))\n(.*?)^```/msg) {
		my ($name, $block) = (basename($document) . ".$1", $2);

		open my $out, '>:raw', "$folder/$name" or die;
		print $out $block;
		close $out or die;
	}
}
my @samples = glob "$top/ladders/*.io";
my @maps = (glob("$top/ladders/boards/*.io"), glob("$top/ladders/*/*.io"), @samples, glob("$folder/*.io"));
cmp_ok(scalar @maps, '>=', 10, 'maps were found');
is(errors_of($_), '', basename($_)) for @maps;

# Each input and output of a sample that has a map is in it, and each output has a safe value.
for my $map (@samples) {
	my $project = $map =~ s/\.io$//r;
	my $json = `$ladder check --json --io '$map' '@{[-e "$project.rung" ? "$project.rung" : $project]}'`;
	my $said = decode_json($json)->[0];

	is(join(' ', map "$_->{code} $_->{arg}", grep { $_->{code} =~ /LD515|LD030/ || !$said->{good} } @{$said->{diagnostics}}), '',
		basename($map) . ': fits its program');
}
my @analog = grep { slurp($_) =~ /AT %\w*(?:A[IQ]|[IQ][WDL])/ } grep { !/plant\.rung$/ } glob "$top/ladders/*.rung";
is(join(' ', map { basename($_) } grep { !-e s/\.rung$/.io/r } @analog), '', 'samples with analog values have a map');

SKIP: {
	my ($overlay) = glob "$folder/*.dts";
	ok($overlay, 'docs/field.md has an overlay');
	skip 'no dtc: apt-get install device-tree-compiler', 1 if system('command -v dtc >/dev/null') != 0;
	is(system('dtc', '-q', '-@', '-I', 'dts', '-O', 'dtb', '-o', "$folder/overlay", $overlay), 0, 'it compiles');
}
done_testing();
