static class FirstCut
{
    static void Main()
    {
        using (var world = new Kiri.World())
        {
            Kiri.Sheet sheet = world.CreateRectangle(1.0f, 1.0f, 32, 32);
            sheet.Cut(-0.1f, 0.4f, 0.5f, 0.6f, 1.1f, 0.4f);
            while (world.Tick(1.0f / 60.0f, 2) == Kiri.Status.Pending) { }
            System.Console.WriteLine(sheet.GetCounts().Pieces + " pieces");
        }
    }
}
