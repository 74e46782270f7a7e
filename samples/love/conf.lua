function love.conf(t)
    t.identity = "kiri-love"
    t.version = "11.4"
    t.window.title = "Kiri in LOVE: slice, so that crate and ball come to rest in the basket"
    t.window.width, t.window.height = 960, 640
    t.window.msaa = 4
    t.modules.joystick, t.modules.video, t.modules.audio, t.modules.sound = false, false, false, false
end
